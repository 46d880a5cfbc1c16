// Scales of a matrix by its largest products.
#pragma once

#include "courant/core/linear/equilibration.hpp"

namespace courant {

// Row and column scales, powers of two, for a sparse matrix A: with a matching of rows and columns of
// largest product Π |a_iσ(i)|, and its dual variables u, v as scales,
//
//   S = diag(2^u) A diag(2^v),   |S_ij| ≤ 1,   |S_iσ(i)| = 1   (to a factor of 2).
//
// Small entries, however many, change nothing: a matrix that is well conditioned but for units stays
// so with entries of 10⁻¹⁰ added, where a least squares fit of logarithms (Equilibration) would make
// all of them as equal as can be. Rows and columns outside of the matching have a largest entry of 1.
// A should be levelled already: where a part of it has fewer rows than columns or the reverse, the
// units of what is left over decide which are matched.
// Reference: Duff, Koster, On algorithms for permuting large entries to the diagonal of a sparse
// matrix (2001).
struct ProductScaling {
  VectorXd row_scale, column_scale;

  explicit ProductScaling(const SparseMatrixXd& A);
};

}  // namespace courant
