#include "courant/manifolds/stiefel.hpp"

#include <stdexcept>

#include "courant/core/expressions/linear_algebra.hpp"
#include "courant/core/linear/singular_value_decomposition.hpp"
#include "courant/manifolds/row_major.hpp"

namespace courant {

Stiefel::Stiefel(Index n, Index k)
    : Manifold("Stiefel(" + std::to_string(n) + ", " + std::to_string(k) + ")",
               n * k - k * (k + 1) / 2, n * k, n * k),
      n_(n),
      k_(k) {
  if (k < 1 || k > n)
    throw std::invalid_argument(name() + "::Stiefel: k is " + std::to_string(k) +
                                "; expected 1 ≤ k ≤ n = " + std::to_string(n) + ".");
}

ExprVector Stiefel::do_retract(const ExprVector& x, const ExprVector& v) const {
  const ExprMatrix X = matrix_of(x, n_, k_);
  const ExprMatrix V = matrix_of(v, n_, k_);
  const ExprMatrix PV = V - Expr(0.5) * (X * (X.transpose() * V));
  const ExprMatrix half_W = Expr(0.5) * (PV * X.transpose() - X * PV.transpose());
  const ExprMatrix one = ExprMatrix::Identity(n_, n_);
  // 1 - W/2 has a definite symmetric part, so elimination needs no pivots.
  return vector_of(solve(one - half_W, X + half_W * X));
}

ExprVector Stiefel::do_inverse_retract(const ExprVector& x, const ExprVector& y) const {
  const ExprMatrix X = matrix_of(x, n_, k_);
  const ExprMatrix Y = matrix_of(y, n_, k_);
  const ExprMatrix A = X.transpose() * Y;
  const ExprMatrix one = ExprMatrix::Identity(k_, k_);
  const ExprMatrix inverse = solve(one + A, one);  // M⁻¹
  const ExprMatrix skew = inverse.transpose() * (A - A.transpose());
  return vector_of(Expr(2.0) * (X * skew + Y - X * A) * inverse);
}

ExprMatrix Stiefel::do_frame(const ExprVector& x) const {
  const ExprMatrix X = matrix_of(x, n_, k_);
  ExprMatrix result(n_ * k_, n_ * k_);
  for (Index j = 0; j < n_ * k_; ++j) {
    const ExprMatrix V = matrix_of(ExprVector::Unit(n_ * k_, j), n_, k_);
    const ExprMatrix XtV = X.transpose() * V;
    result.col(j) = vector_of(V - Expr(0.5) * (X * (XtV + XtV.transpose())));
  }
  return result;
}

ExprVector Stiefel::do_constraint(const ExprVector& x) const {
  const ExprMatrix X = matrix_of(x, n_, k_);
  ExprVector result(k_ * (k_ + 1) / 2);
  for (Index i = 0, row = 0; i < k_; ++i)
    for (Index j = 0; j <= i; ++j, ++row)
      result[row] = X.col(i).dot(X.col(j)) - (i == j ? 1.0 : 0.0);
  return result;
}

VectorXd Stiefel::do_project(const VectorXd& x) const {
  const MatrixXd X = x.reshaped<Eigen::RowMajor>(n_, k_);
  const auto [sigma, U, V] = singular_value_decomposition(X);
  if (!(sigma[k_ - 1] > 0.0))
    throw std::domain_error(name() + "::project: x has linearly dependent columns; expected rank " +
                            std::to_string(k_) + ". No frame is nearest to it.");
  return (U.leftCols(k_) * V.transpose()).eval().reshaped<Eigen::RowMajor>();
}

}  // namespace courant
