// RankDecision: the rank of a matrix, with the evidence for it.
#pragma once

#include <Eigen/Core>
#include <iosfwd>

namespace courant {

using Eigen::Index;
using Eigen::VectorXd;

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

}  // namespace courant
