// A P = Q [T 0; 0 0] Zᵀ, and with it the least-squares solutions of least norm.
#pragma once

#include "courant/core/linear/qr_decomposition.hpp"
#include "courant/core/linear/rank_decision.hpp"

namespace courant {

// A matrix A (m × n, sizes may be 0) of rank r, as Q [T 0; 0 0] Zᵀ Pᵀ with orthogonal Q and Z, a
// permutation P and a regular triangle T (r × r): what an iteration solves with at each step.
//
// The rank is decided on the pivots |r_ii| of Q R = A P, which bound the singular values closely
// enough to solve with, by the rule of RankDecision. Rows and columns are taken as they are: their
// units are the caller's choice, which least squares and least norms depend on anyway. Sizes are
// relative to the largest pivot; `data_error` says below what, next to it, nothing is to be divided
// by. Where a rank is itself the result, take FundamentalSubspaces: singular values, equilibrated.
class CompleteOrthogonalDecomposition {
 public:
  // Throws std::domain_error if an entry is not finite.
  explicit CompleteOrthogonalDecomposition(const Eigen::Ref<const MatrixXd>& A,
                                           double data_error = 0.0);

  const RankDecision& decision() const { return decision_; }
  Index rank() const { return decision_.rank; }
  // Of the pivots: the first rank() columns of A in this order are independent.
  const std::vector<Index>& order() const { return range_.order(); }

  // Q, m × m: the first rank() columns span the range of A, the others the kernel of Aᵀ.
  MatrixXd Q() const { return range_.Q(); }

  // A⁺ B: the solutions of least norm among the least-squares solutions of A X = B. B has m rows.
  MatrixXd solve(const Eigen::Ref<const MatrixXd>& B) const;
  MatrixXd pseudo_inverse() const;

 private:
  QrDecomposition range_;  // A P = Q R
  RankDecision decision_;
  QrDecomposition row_space_;  // of the first r rows of R, transposed; empty if r = n and Z = 1
  MatrixXd T_;
};

}  // namespace courant
