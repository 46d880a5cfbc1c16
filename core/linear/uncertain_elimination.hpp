// UncertainElimination: the rank of an uncertain matrix by elimination.
#pragma once

#include <vector>

#include "courant/core/linear/uncertain_matrix.hpp"

namespace courant {

// Gaussian elimination of the matrices |A - value| ≤ error (m × n) all at once: with both rows and columns
// exchanged for the largest pivot, in numbers that carry bounds of their errors. A pivot above its bound
// is not zero in any of them, so that all have at least the rank of the number of pivots.
//
// A norm has one unit for all errors; here each entry keeps its own. So pivots that are small where errors are
// small still count, as the product of two entries of 10⁻⁷ among entries of 1, which singular values do not
// show. Dense: for up to a few hundred rows and columns. A should have comparable rows and columns, since
// the largest pivot makes the least errors.
struct UncertainElimination {
  explicit UncertainElimination(const UncertainMatrix& A);

  Index rank = 0;
  std::vector<double> margins;  // how many times its error each pivot is; ∞ for exact ones
  double left = 0.0;            // the largest entry that is left, in units of its error; at most 1
};

}  // namespace courant
