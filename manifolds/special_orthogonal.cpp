#include "courant/manifolds/special_orthogonal.hpp"

#include <limits>
#include <stdexcept>

#include "courant/core/expressions/linear_algebra.hpp"
#include "courant/core/linear/lu_decomposition.hpp"
#include "courant/core/linear/singular_value_decomposition.hpp"
#include "courant/manifolds/row_major.hpp"

namespace courant {
namespace {

ExprMatrix one(Index n) { return ExprMatrix::Identity(n, n); }

// V of its entries above the diagonal, and back from the skew part of a matrix.
ExprMatrix skew(const ExprVector& v, Index n) {
  ExprMatrix V = ExprMatrix::Zero(n, n);
  for (Index i = 0, a = 0; i < n; ++i)
    for (Index j = i + 1; j < n; ++j, ++a) {
      V(i, j) = v[a];
      V(j, i) = -v[a];
    }
  return V;
}
ExprVector entries(const ExprMatrix& A) {
  const Index n = A.rows();
  ExprVector v(n * (n - 1) / 2);
  for (Index i = 0, a = 0; i < n; ++i)
    for (Index j = i + 1; j < n; ++j, ++a) v[a] = 0.5 * (A(i, j) - A(j, i));
  return v;
}

}  // namespace

SpecialOrthogonal::SpecialOrthogonal(Index n)
    : Manifold("SpecialOrthogonal(" + std::to_string(n) + ")", n * (n - 1) / 2, n * n,
               n * (n - 1) / 2),
      n_(n) {
  if (n < 1)
    throw std::invalid_argument(name() + "::SpecialOrthogonal: n is " + std::to_string(n) +
                                "; expected n ≥ 1.");
}

ExprVector SpecialOrthogonal::do_retract(const ExprVector& x, const ExprVector& v) const {
  const ExprMatrix half = Expr(0.5) * skew(v, n_);
  // 1 - V/2 has the symmetric part 1, so elimination needs no pivots.
  return vector_of(matrix_of(x, n_, n_) * solve(one(n_) - half, one(n_) + half));
}

ExprVector SpecialOrthogonal::do_inverse_retract(const ExprVector& x, const ExprVector& y) const {
  const ExprMatrix Y = matrix_of(x, n_, n_).transpose() * matrix_of(y, n_, n_);
  // The symmetric part of 1 + Y is definite unless Y has the eigenvalue -1.
  return entries(Expr(2.0) * solve(one(n_) + Y, Y - one(n_)));
}

std::optional<VectorXd> SpecialOrthogonal::do_unit() const {
  return MatrixXd::Identity(n_, n_).reshaped().eval();
}

ExprMatrix SpecialOrthogonal::do_frame(const ExprVector& x) const {
  const ExprMatrix X = matrix_of(x, n_, n_);
  ExprMatrix result(n_ * n_, tangent_dimension());
  for (Index a = 0; a < tangent_dimension(); ++a)
    result.col(a) = vector_of(X * skew(ExprVector::Unit(tangent_dimension(), a), n_));
  return result;
}

ExprMatrix SpecialOrthogonal::do_coframe(const ExprVector& x) const {
  return Expr(0.5) *
         do_frame(x).transpose();  // the columns of the frame are orthogonal, of length √2
}

ExprVector SpecialOrthogonal::do_constraint(const ExprVector& x) const {
  const ExprMatrix X = matrix_of(x, n_, n_);
  ExprVector result(n_ * (n_ + 1) / 2);
  for (Index i = 0, row = 0; i < n_; ++i)
    for (Index j = 0; j <= i; ++j, ++row)
      result[row] = X.col(i).dot(X.col(j)) - (i == j ? 1.0 : 0.0);
  return result;
}

double SpecialOrthogonal::do_point_defect(const VectorXd& x) const {
  const MatrixXd X = x.reshaped<Eigen::RowMajor>(n_, n_);
  if (!(LuDecomposition(X).determinant() > 0.0)) return std::numeric_limits<double>::infinity();
  return constraint(x).lpNorm<Eigen::Infinity>();
}

VectorXd SpecialOrthogonal::do_project(const VectorXd& x) const {
  auto [sigma, U, V] = singular_value_decomposition(MatrixXd(x.reshaped<Eigen::RowMajor>(n_, n_)));
  const bool is_reflection =
      LuDecomposition(U).orientation() * LuDecomposition(V).orientation() < 0;
  // The least singular value turns its sign; where it is not simple several points are nearest.
  const double next = is_reflection && n_ > 1 ? sigma[n_ - 2] - sigma[n_ - 1] : sigma[n_ - 1];
  if (!(next > 0.0) || (is_reflection && n_ == 1))
    throw std::domain_error(name() + "::project: no rotation is nearest to x; expected a matrix " +
                            "with a positive determinant.");
  if (is_reflection) U.col(n_ - 1) *= -1.0;
  return (U * V.transpose()).eval().reshaped<Eigen::RowMajor>();
}

VectorXd SpecialOrthogonal::do_random_point(std::mt19937& generator) const {
  std::normal_distribution<double> normal;
  MatrixXd X = MatrixXd::NullaryExpr(n_, n_, [&] { return normal(generator); });
  if (LuDecomposition(X).orientation() < 0) X.row(0) *= -1.0;
  return project(X.reshaped<Eigen::RowMajor>().eval());
}

}  // namespace courant
