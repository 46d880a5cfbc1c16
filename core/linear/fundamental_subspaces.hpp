// FundamentalSubspaces: rank, kernel and range of a dense matrix.
#pragma once

#include <Eigen/Core>

#include "courant/core/linear/rank_decision.hpp"

namespace courant {

using Eigen::MatrixXd;

// By the singular value decomposition. Throws std::domain_error if an entry is not finite.
RankDecision decide_rank(const Eigen::Ref<const MatrixXd>& A, const RankOptions& options = {});

// The four subspaces of A (m × n) and its pseudo-inverse, all on one rank decision.
//
//   kernel      {x : Ax = 0}      n × (n-r)          row_space   im Aᵀ   n × r
//   left_kernel {y : yᵀA = 0}     m × (m-r)          range       im A    m × r
//
// Columns are orthonormal, [range left_kernel] and [row_space kernel] are orthogonal matrices:
// bases for A itself, the scales of the equilibration are undone.
//
// Rounding noise next to the only number of its row, a small one, is too large for equilibrate to
// see it as noise, and is scaled up: that can leave 2 digits of a basis of an orthogonal matrix's
// blocks. It shows in the residuals AX and YᵀA of the kernels X, Y; where those are beyond
// rounding, the kernels of the decided rank are taken from A as it is, if these have smaller ones.
class FundamentalSubspaces {
 public:
  explicit FundamentalSubspaces(const Eigen::Ref<const MatrixXd>& A,
                                const RankOptions& options = {});

  const RankDecision& decision() const { return decision_; }
  Index rank() const { return decision_.rank; }

  MatrixXd kernel() const { return rows_.rightCols(rows_.cols() - rank()); }
  MatrixXd row_space() const { return rows_.leftCols(rank()); }
  MatrixXd left_kernel() const { return columns_.rightCols(columns_.cols() - rank()); }
  MatrixXd range() const { return columns_.leftCols(rank()); }

  // A⁺B: the least-squares solution of least norm of AX = B, columnwise. B is m × k.
  MatrixXd pseudo_solve(const Eigen::Ref<const MatrixXd>& B) const;

 private:
  void prefer_smaller_residuals(const Eigen::Ref<const MatrixXd>& A, const RankOptions& options);

  RankDecision decision_;
  MatrixXd rows_;     // [row_space kernel]
  MatrixXd columns_;  // [range left_kernel]
  MatrixXd core_;     // rangeᵀ A row_space, regular
};

// Orthonormal bases where only one is wanted.
MatrixXd kernel(const Eigen::Ref<const MatrixXd>& A, const RankOptions& options = {});
MatrixXd range(const Eigen::Ref<const MatrixXd>& A, const RankOptions& options = {});

}  // namespace courant
