// The singular value decomposition of a dense matrix.
#pragma once

#include "courant/core/linear/singular_vectors.hpp"

namespace courant {

// Up to 24 values by Eigen's Jacobi rotations, whose bits are the same everywhere. More of them by LAPACK, which SuiteSparse
// needs anyway, or (COURANT_WITH_SUITESPARSE=OFF) by rotations too, which are slower. The divide-and-conquer of Eigen 3.4.0
// is as fast as LAPACK, but goes wrong, even out of bounds, on clusters of equal singular values, as blocks of orthogonal
// matrices have them.
//
// Entries have to be finite. Throws std::domain_error if they are not, std::runtime_error if LAPACK does not converge.
SingularValueDecomposition singular_value_decomposition(const Eigen::Ref<const MatrixXd>& A);

// σ alone.
VectorXd singular_values(const Eigen::Ref<const MatrixXd>& A);

}  // namespace courant
