// Singular values of matrices that are too large for rotations: by LAPACK where it is. Not installed API.
#pragma once

#include "courant/core/linear/singular_vectors.hpp"

namespace courant {

// A has entries, all of them finite; U and V are empty where no vectors are asked for. Throws std::runtime_error if LAPACK does
// not converge.
SingularValueDecomposition large_singular_values(const Eigen::Ref<const MatrixXd>& A,
                                                 Vectors vectors);

// The same by Eigen's Jacobi rotations.
SingularValueDecomposition rotated_singular_values(const Eigen::Ref<const MatrixXd>& A,
                                                   Vectors vectors);

}  // namespace courant
