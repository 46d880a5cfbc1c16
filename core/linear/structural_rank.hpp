// The rank that the pattern of a matrix allows.
#pragma once

#include <Eigen/SparseCore>

#include "courant/core/linear/equilibration.hpp"

namespace courant {

// The largest rank of the matrices that have entries only where A (m × n) has some that are not zero, and the
// rank of nearly all of these: the number of pairs in a largest matching of rows and columns.
Index structural_rank(const SparseMatrixXd& A);

}  // namespace courant
