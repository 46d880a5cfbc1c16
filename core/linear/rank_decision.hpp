// RankDecision: the rank of a matrix, with the evidence for it.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <iosfwd>

#include "courant/core/linear/equilibration.hpp"

namespace courant {

// What is known of a matrix besides its entries.
struct RankOptions {
  // How uncertain the entries are, next to the largest of their row and column: 0 for exact data,
  // 1e-10 for a Jacobian at a point that an iteration found to about ten digits.
  double data_error = 0.0;

  // 0: rows and columns are equilibrated, each has its own unit. Positive: they share one, and this
  // is the size that rounding errors are relative to, as 1 for a block of an orthogonal matrix,
  // which may be all noise and must not be scaled up. Dense matrices only.
  double magnitude = 0.0;

  // The norm of a bound of the errors, in the units of the matrix as it is given (with a magnitude
  // only): then the singular values above it, and above the rounding of the decomposition, count.
  double error_norm = 0.0;
};

// The rank r of an m × n matrix A, decided on the singular values σ₁ ≥ σ₂ ≥ … of A with its rows
// and columns equilibrated (so that units, and the order of equations and unknowns, do not matter).
//
//   noise floor   ε = max(m, n) · eps · σ₁ + (√m + √n) · data_error
//   σ > 10²ε      is a number,   σ ≤ ε is zero;   in between r is taken where the gap is largest:
//   gap           σ_r / max(σ_{r+1}, ε),   σ₀ = 1 (or the magnitude), σ_{r+1} = 0 for r = min(m, n)
//
// ε is the rounding of the decomposition, and the norm of a random error of that size.
// Laws: r(PAQ) = r(A) for permutations P, Q; r(D₁AD₂) = r(A) for diagonal D₁, D₂ > 0 in the sense
// of Equilibration; r(Aᵀ) = r(A). A gap below 10³ is ambiguous, and says so.
struct RankDecision {
  Index rank = 0;
  Index rows = 0, columns = 0;
  VectorXd singular_values;  // of the equilibrated matrix, decreasing. Sparse: the largest, those
                             // next to the cut
  double above = 0.0;        // σ_r (0 if r = 0). Sparse: estimated, see decide_rank
  double below = 0.0;        // σ_{r+1} (0 if there is none). Sparse: an upper bound
  double gap = 0.0;
  double threshold = 0.0;  // between the two: what is above it counts

  bool is_doubtful = true;

  Index nullity() const { return columns - rank; }
  bool ambiguous() const { return is_doubtful; }
};

// One line: rank 3 of 5 × 4, gap 2.1e+14 (0.38 | 6e-17, threshold 2.6e-08)
std::ostream& operator<<(std::ostream& out, const RankDecision& decision);

// By the singular value decomposition. Throws std::domain_error if an entry is not finite.
RankDecision decide_rank(const Eigen::Ref<const MatrixXd>& A, const RankOptions& options = {});

// The same for a sparse matrix, by a rank-revealing sparse QR: A E = Q [R W; 0 δ], with R square and triangular.
// QR looks at the diagonal of R only; a triangle can be singular with ones on it. So the smallest
// singular values of R are computed too, by inverse iteration, and what W adds in their directions:
// they bound σ_r from below (to about 5 %), and together with δ they bound σ_{r+1} from above; where
// r = min(m, n) there is none, and δ lowers the bound of σ_r. The
// gap is that of the dense decision or less. If R⁻¹ overflows, the decision is ambiguous with gap
// 0.
RankDecision decide_rank(const SparseMatrixXd& A, const RankOptions& options = {});

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
