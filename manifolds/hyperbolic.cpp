#include "courant/manifolds/hyperbolic.hpp"

#include <cmath>

namespace courant {
namespace {

// J x
ExprVector lowered(ExprVector x) {
  x[0] = -x[0];
  return x;
}

}  // namespace

Hyperbolic::Hyperbolic(Index dimension)
    : Manifold("Hyperbolic(" + std::to_string(dimension) + ")", dimension, dimension + 1,
               dimension + 1) {}

ExprVector Hyperbolic::do_retract(const ExprVector& x, const ExprVector& v) const {
  const Expr s = -lowered(v).dot(v);  // c_0(-θ²) = cosh θ
  return stumpff(0, s) * x + stumpff(1, s) * v;
}

ExprVector Hyperbolic::do_inverse_retract(const ExprVector& x, const ExprVector& y) const {
  const Expr c = -lowered(x).dot(y);
  return arccos_factor(0, c) * (y - c * x);
}

ExprMatrix Hyperbolic::do_frame(const ExprVector& x) const {
  return ExprMatrix::Identity(x.size(), x.size()) + x * lowered(x).transpose();
}

// The sheet as a graph over R^n, which the equation ⟨x, x⟩_L = -1 alone would not single out.
ExprVector Hyperbolic::do_constraint(const ExprVector& x) const {
  return ExprVector::Constant(1, x[0] - sqrt(1.0 + x.tail(dimension()).squaredNorm()));
}

VectorXd Hyperbolic::do_project(const VectorXd& x) const {
  VectorXd result = x;
  result[0] = std::sqrt(1.0 + x.tail(dimension()).squaredNorm());
  return result;
}

}  // namespace courant
