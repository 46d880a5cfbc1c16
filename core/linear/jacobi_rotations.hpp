// Singular values by rotations.
#pragma once

#include "courant/core/linear/singular_value_decomposition.hpp"

namespace courant {

// By Eigen's Jacobi rotations, all of U and V or (`is_whole`: false) the values alone. Slower than
// LAPACK for large matrices, and of the same bits whatever BLAS there is.
SingularValueDecomposition by_rotations(const Eigen::Ref<const MatrixXd>& A, bool is_whole);

}  // namespace courant
