#include "courant/manifolds/symmetric_positive_definite.hpp"

#include <limits>
#include <stdexcept>

#include "courant/core/expressions/linear_algebra.hpp"
#include "courant/core/linear/cholesky_decomposition.hpp"

namespace courant {
namespace {

// The symmetric matrix with this lower triangle, and back.
template <class Scalar>
Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> symmetric(
    const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& x, Index n) {
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> X(n, n);
  for (Index i = 0, k = 0; i < n; ++i)
    for (Index j = 0; j <= i; ++j, ++k) X(i, j) = X(j, i) = x[k];
  return X;
}

ExprVector lower_triangle(const ExprMatrix& X) {
  ExprVector x(X.rows() * (X.rows() + 1) / 2);
  for (Index i = 0, k = 0; i < X.rows(); ++i)
    for (Index j = 0; j <= i; ++j, ++k) x[k] = X(i, j);
  return x;
}

// L lower triangular with L Lᵀ = X.
ExprMatrix cholesky(const ExprMatrix& X) {
  const Index n = X.rows();
  ExprMatrix L = ExprMatrix::Zero(n, n);
  for (Index j = 0; j < n; ++j) {
    L(j, j) = sqrt(X(j, j) - L.row(j).head(j).squaredNorm());
    for (Index i = j + 1; i < n; ++i)
      L(i, j) = (X(i, j) - L.row(i).head(j).dot(L.row(j).head(j))) / L(j, j);
  }
  return L;
}

}  // namespace

SymmetricPositiveDefinite::SymmetricPositiveDefinite(Index n)
    : Manifold("SymmetricPositiveDefinite(" + std::to_string(n) + ")", n * (n + 1) / 2,
               n * (n + 1) / 2, n * (n + 1) / 2),
      n_(n) {
  if (n < 0)
    throw std::invalid_argument(name() +
                                "::SymmetricPositiveDefinite: n is negative; expected a "
                                "number of rows.");
}

ExprVector SymmetricPositiveDefinite::do_retract(const ExprVector& x, const ExprVector& v) const {
  ExprMatrix L = cholesky(symmetric(x, n_));
  const ExprMatrix half = solve(L, symmetric(v, n_));                // L⁻¹V
  const ExprMatrix scaled = solve(L, ExprMatrix(half.transpose()));  // L⁻¹V L⁻ᵀ
  ExprMatrix A = scaled.triangularView<Eigen::StrictlyLower>();
  A.diagonal() = Expr(0.5) * scaled.diagonal();
  A = L * A;
  for (Index i = 0; i < n_; ++i) {
    L.row(i).head(i) += A.row(i).head(i);
    L(i, i) *= exp(A(i, i) / L(i, i));
  }
  return lower_triangle(L * L.transpose());
}

ExprVector SymmetricPositiveDefinite::do_inverse_retract(const ExprVector& x,
                                                         const ExprVector& y) const {
  const ExprMatrix L = cholesky(symmetric(x, n_));
  ExprMatrix A = cholesky(symmetric(y, n_));
  for (Index i = 0; i < n_; ++i) {
    A.row(i).head(i) -= L.row(i).head(i);
    A(i, i) = L(i, i) * log(A(i, i) / L(i, i));
  }
  const ExprMatrix half = A * L.transpose();
  return lower_triangle(half + half.transpose());
}

ExprMatrix SymmetricPositiveDefinite::do_frame(const ExprVector& x) const {
  return ExprMatrix::Identity(x.size(), x.size());
}

double SymmetricPositiveDefinite::do_point_defect(const VectorXd& x) const {
  return CholeskyDecomposition(symmetric(x, n_)).is_positive_definite()
             ? 0.0
             : std::numeric_limits<double>::infinity();
}

VectorXd SymmetricPositiveDefinite::do_project(const VectorXd& x) const {
  if (point_defect(x) != 0.0)
    throw std::domain_error(name() +
                            "::project: x is not positive definite; expected a point of "
                            "this open set. No point of it is nearest to others.");
  return x;
}

VectorXd SymmetricPositiveDefinite::do_random_point(std::mt19937& generator) const {
  std::normal_distribution<double> normal;
  const MatrixXd A = MatrixXd::NullaryExpr(n_, n_, [&] { return normal(generator); });
  // A Aᵀ is positive definite, almost surely; 1 keeps it away from the boundary.
  return values(
      lower_triangle(constants(MatrixXd(A * A.transpose() + MatrixXd::Identity(n_, n_)))));
}

}  // namespace courant
