// The singular value decomposition of a dense matrix.
#pragma once

#include <Eigen/Core>

namespace courant {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// A = U diag(σ) Vᵀ, A of size m × n: σ₁ ≥ σ₂ ≥ … ≥ 0, min(m, n) values; U (m × m) and V (n × n)
// orthogonal. Sizes may be 0.
//
// By Eigen's Jacobi rotations where min(m, n) ≤ 64, and for larger matrices by LAPACK, which SuiteSparse needs anyway,
// or (COURANT_WITH_SUITESPARSE=OFF) by rotations too, which are slower. The divide-and-conquer of Eigen 3.4.0 is as
// fast as LAPACK, but goes wrong, even out of bounds, on clusters of equal singular values, as blocks of orthogonal
// matrices have them.
struct SingularValueDecomposition {
  VectorXd values;
  MatrixXd U, V;
};

// Entries have to be finite. Throws std::runtime_error if LAPACK does not converge.
SingularValueDecomposition singular_value_decomposition(const Eigen::Ref<const MatrixXd>& A);

// σ alone.
VectorXd singular_values(const Eigen::Ref<const MatrixXd>& A);

}  // namespace courant
