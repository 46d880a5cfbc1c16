#include "courant/integrators/maps/staggered.hpp"

#include <stdexcept>

namespace courant {

Staggered::Staggered(std::shared_ptr<const Manifold> manifold, VectorXd theta)
    : DiscretizationMap("Staggered", std::move(manifold)), theta_(std::move(theta)) {
  const Manifold& M = *this->manifold();
  if (!M.has_identity_frame())
    throw std::invalid_argument("Staggered::Staggered: the frames of " + M.name() +
                                " are not the identity; expected a space such as Rⁿ.");
  if (theta_.size() != M.dimension() ||
      !((theta_.array() >= 0.0).all() && (theta_.array() <= 1.0).all()))
    throw std::invalid_argument("Staggered::Staggered: theta is not " +
                                std::to_string(M.dimension()) +
                                " numbers in [0, 1], one for each coordinate.");
}

// x₀ + Θ v, which is x₀ or x₁ itself where θ is 0 or 1.
ExprVector Staggered::between(const ExprVector& x0, const ExprVector& displacement) const {
  const ExprVector end = manifold()->retract(x0, displacement);
  const ExprVector inside =
      manifold()->retract(x0, ExprVector(constants(theta_).cwiseProduct(displacement)));
  ExprVector x = x0;
  for (Index i = 0; i < x.size(); ++i)
    if (theta_[i] != 0.0) x[i] = theta_[i] == 1.0 ? end[i] : inside[i];
  return x;
}

DiscretizationMap::PointPair<Expr> Staggered::do_forward(const ExprVector& x,
                                                         const ExprVector& v) const {
  const Manifold& M = *manifold();
  const ExprVector theta = constants(theta_);
  return {M.retract(x, ExprVector(-theta.cwiseProduct(v))),
          M.retract(x, ExprVector(v - theta.cwiseProduct(v)))};
}

DiscretizationMap::TangentVector<Expr> Staggered::do_inverse(const ExprVector& x0,
                                                             const ExprVector& x1) const {
  ExprVector v = manifold()->inverse_retract(x0, x1), x = between(x0, v);
  for (Index i = 0; i < x.size(); ++i)
    if (theta_[i] == 1.0) x[i] = x1[i];
  return {std::move(x), std::move(v)};
}

}  // namespace courant
