#include "courant/integrators/maps/theta.hpp"

#include <stdexcept>

#include "courant/core/words/message.hpp"

namespace courant {

Theta::Theta(std::shared_ptr<const Manifold> manifold, double theta)
    : DiscretizationMap("Theta(" + number_text(theta) + ")", std::move(manifold)), theta_(theta) {
  if (!(theta >= 0.0 && theta <= 1.0))
    throw std::invalid_argument("Theta::Theta: theta is " + number_text(theta) +
                                "; expected a number in [0, 1].");
}

bool Theta::has_inverse() const {
  return manifold()->has_inverse() && (theta_ == 0.0 || theta_ == 1.0 || manifold()->is_geodesic());
}

DiscretizationMap::PointPair<Expr> Theta::do_forward(const ExprVector& x,
                                                     const ExprVector& v) const {
  return {manifold()->retract(x, ExprVector(Expr(-theta_) * v)),
          manifold()->retract(x, ExprVector(Expr(1.0 - theta_) * v))};
}

DiscretizationMap::TangentVector<Expr> Theta::do_inverse(const ExprVector& x0,
                                                         const ExprVector& x1) const {
  const Manifold& M = *manifold();
  if (theta_ == 0.0) return {x0, M.inverse_retract(x0, x1)};
  if (theta_ == 1.0) return {x1, -M.inverse_retract(x1, x0)};
  // On the geodesic from x₀ to x₁; seen from x, both ends lie along one vector.
  const ExprVector x = M.retract(x0, ExprVector(Expr(theta_) * M.inverse_retract(x0, x1)));
  return {x, M.inverse_retract(x, x1) - M.inverse_retract(x, x0)};
}

DiscretizationMap::Displacement Theta::do_from_start(const ExprVector& x0,
                                                     const ExprVector& w) const {
  const Manifold& M = *manifold();
  if (theta_ == 0.0) return {x0, w, M.retract(x0, w)};
  if (!M.is_geodesic()) {
    if (!M.has_source()) return from_start_by_inverse(x0, w);
    const ExprVector x = M.source(x0, ExprVector(Expr(-theta_) * w));
    return {x, w, M.retract(x, ExprVector(Expr(1.0 - theta_) * w))};
  }
  return {M.retract(x0, ExprVector(Expr(theta_) * w)), M.velocity_along(x0, w, theta_),
          M.retract(x0, w)};
}

}  // namespace courant
