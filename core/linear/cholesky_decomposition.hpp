// A = L Lᵀ.
#pragma once

#include <Eigen/Core>

namespace courant {

using Eigen::MatrixXd;

// A symmetric positive definite A (n × n, of which the lower triangle is read) as L Lᵀ, L a lower
// triangle with a positive diagonal. A matrix that is not positive definite has no such L:
// is_positive_definite() says so.
class CholeskyDecomposition {
 public:
  // Throws std::invalid_argument if A is not square.
  explicit CholeskyDecomposition(const Eigen::Ref<const MatrixXd>& A);

  bool is_positive_definite() const { return is_positive_definite_; }
  const MatrixXd& L() const { return L_; }

  // L⁻¹ B, B of size n × k: for A = 1 as a metric, the components of B in an orthonormal basis.
  MatrixXd solve_lower(const Eigen::Ref<const MatrixXd>& B) const;

 private:
  MatrixXd L_;
  bool is_positive_definite_ = false;
};

// A⁻¹ B for a symmetric positive semidefinite A (n × n, of which the lower triangle is read) by L D Lᵀ with pivots, B
// of size n × k. Along directions that A does not see the solution is 0. Throws std::invalid_argument if A is not
// square or B has not n rows.
MatrixXd semidefinite_solution(const Eigen::Ref<const MatrixXd>& A,
                               const Eigen::Ref<const MatrixXd>& B);

}  // namespace courant
