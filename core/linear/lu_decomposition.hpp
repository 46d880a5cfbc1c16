// P A = L U.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace courant {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// A square matrix A (n × n, n ≥ 0) with its rows exchanged so that each pivot is the largest of its
// column, as the product of a unit lower triangle L and an upper triangle U.
//
// A singular matrix is decomposed too; what is solved with it is then not finite or meaningless.
// pivot_ratio() tells: it is of the size of the rounding errors for a singular matrix with rows of
// comparable size.
class LuDecomposition {
 public:
  // Up to so many rows by plain loops, whose order of operations programs in C repeat (c_program): they cost about as
  // much as blocks do. Beyond them by blocks.
  static constexpr Index kPlain = 63;

  LuDecomposition() = default;  // of the 0 × 0 matrix
  // Throws std::invalid_argument if A is not square.
  explicit LuDecomposition(const Eigen::Ref<const MatrixXd>& A) { compute(A); }
  // Another matrix in place of this one. Allocates nothing up to 63 rows, if there were as many before.
  void compute(const Eigen::Ref<const MatrixXd>& A);

  Index size() const { return factors_.rows(); }

  // min |u_ii| / max |u_ii|; 1 for n = 0, 0 for a zero matrix.
  double pivot_ratio() const;
  double determinant() const;
  int orientation() const;  // the sign of the determinant, which does not overflow

  // A⁻¹ B, B of size n × k.
  MatrixXd solve(const Eigen::Ref<const MatrixXd>& B) const;
  void solve(double* b) const;  // b ← A⁻¹ b, n numbers; allocates nothing up to 63 rows
  MatrixXd inverse() const;
  void inverse(MatrixXd& result) const;  // allocates nothing up to 63 rows, if it has the size

 private:
  MatrixXd factors_;         // L below the diagonal, U above
  std::vector<Index> rows_;  // row i of P A is row rows_[i] of A
  int sign_ = 1;             // of P
};

}  // namespace courant
