#include "courant/manifolds/sphere.hpp"

#include <numbers>
#include <stdexcept>

#include "courant/core/words/message.hpp"

namespace courant {

Sphere::Sphere(Index dimension, Retraction retraction)
    : Manifold("Sphere(" + std::to_string(dimension) + ", " + retraction.name + ")", dimension,
               dimension + 1, dimension + 1),
      retraction_(std::move(retraction)) {}

Retraction Sphere::exponential() {
  return {.name = "exponential",
          .map = [](const ExprVector& x, const ExprVector& v) -> ExprVector {
            const Expr s = v.squaredNorm();
            return stumpff(0, s) * x + stumpff(1, s) * v;
          },
          .inverse = [](const ExprVector& x, const ExprVector& y) -> ExprVector {
            const Expr c = x.dot(y);
            return arccos_factor(0, c) * (y - c * x);
          },
          .injectivity_radius = std::numbers::pi,
          .is_geodesic = true,
          .velocity = [](const ExprVector& x, const ExprVector& v, const Expr& s) -> ExprVector {
            const Expr squared = square(s) * v.squaredNorm();
            return stumpff(0, squared) * v - s * v.squaredNorm() * stumpff(1, squared) * x;
          }};
}

Retraction Sphere::projective() {
  return {.name = "projective",
          .map = [](const ExprVector& x, const ExprVector& v) -> ExprVector {
            return (x + v) / sqrt((x + v).squaredNorm());
          },
          .inverse = [](const ExprVector& x, const ExprVector& y) -> ExprVector {
            return y / x.dot(y) - x;
          }};
}

ExprVector Sphere::do_retract(const ExprVector& x, const ExprVector& v) const {
  return retraction_.map(x, v);
}

ExprVector Sphere::do_inverse_retract(const ExprVector& x, const ExprVector& y) const {
  return retraction_.inverse(x, y);
}

ExprVector Sphere::do_velocity_along(const ExprVector& x, const ExprVector& v,
                                     const Expr& s) const {
  return retraction_.velocity ? retraction_.velocity(x, v, s) : differentiated_velocity(x, v, s);
}

ExprMatrix Sphere::do_frame(const ExprVector& x) const {
  return ExprMatrix::Identity(x.size(), x.size()) - x * x.transpose();
}

ExprVector Sphere::do_constraint(const ExprVector& x) const {
  return ExprVector::Constant(1, x.squaredNorm() - 1.0);
}

double Sphere::do_injectivity_radius(const VectorXd&) const {
  return retraction_.injectivity_radius;
}

VectorXd Sphere::do_project(const VectorXd& x) const {
  const double norm = x.norm();
  if (!(norm > 0.0))
    throw std::domain_error(name() + "::project: x has length " + number_text(norm) +
                            "; expected a length above 0. The centre is near no point.");
  return x / norm;
}

}  // namespace courant
