// Equilibration: scales for the rows and columns of a matrix.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace courant {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using SparseMatrixXd = Eigen::SparseMatrix<double>;

// A matrix A (m × n) with its rows and columns made comparable by powers of two r_i, c_j:
//
//   S = diag(r) A diag(c),   max_j |S_ij| ≈ 1 ≈ max_i |S_ij|,   the other |S_ij| as equal as can
//   be.
//
// Laws, for diagonal D₁, D₂ > 0 and permutations P₁, P₂:
//   E1  S(D₁ A D₂) = S(A), up to rounding of r and c to powers of two (which makes S exact)
//   E2  S(P₁ A P₂) = P₁ S(A) P₂
//   E3  zero rows and columns keep the scale 1
// Maxima alone do not determine the scales when the large entries of several rows share a column,
// and E1 fails. So r, c minimise Σ (log₂ r_i + log₂ |a_ij| + log₂ c_j)² over the entries that are
// not zero, which determines S (Curtis & Reid, On the automatic scaling of matrices for Gaussian
// elimination, 1972); maxima are levelled after that (Ruiz, A scaling algorithm to equilibrate both
// rows and columns norms in matrices, 2001).
//
// An entry that is at most `noise` times the largest of its row and of its column, both levelled,
// counts as zero: else a 1e-17 that stands for 0 would be scaled up like a number. So E1 holds as
// far as D₁, D₂ do not push entries below that, and a row or column of nothing but rounding noise
// cannot be told from a small one: whoever knows better sets its entries to zero first. Subnormal
// numbers, below 2^-1022, count as zero: they have lost their digits.
template <class Matrix>
struct Equilibration {
  Matrix scaled;                     // S
  VectorXd row_scale, column_scale;  // r (m), c (n)
};

// Throws std::domain_error if an entry is not finite.
Equilibration<MatrixXd> equilibrate(const Eigen::Ref<const MatrixXd>& A, double noise);
Equilibration<SparseMatrixXd> equilibrate(const SparseMatrixXd& A, double noise);

}  // namespace courant
