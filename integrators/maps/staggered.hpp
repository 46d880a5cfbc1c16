// Theta maps with a θ for each coordinate.
#pragma once

#include "courant/integrators/maps/discretization_map.hpp"

namespace courant {

// R_d(x, v) = (x - Θ v, x + (1 - Θ) v), Θ = diag(θ_1, …, θ_n), 0 ≤ θ_i ≤ 1, where the retraction of M is x + v, as on
// Rⁿ: the product of maps Theta(θ_i), one for each coordinate, for spaces that are not written as products.
//
// With θ = 0 for some coordinates, a, and 1 for the others, b, the system is evaluated at (a₀, b₁). Where the rate of
// each of the two depends on the other one alone, a step is explicit: b₁ = b₀ + h β(a₀), a₁ = a₀ + h α(b₁). Charges
// and fluxes of a lossless circuit are such coordinates; so are positions and momenta of T*Rⁿ, where the cotangent lift
// of Theta(0) is this map. Time is taken at the beginning of a step. Of order 1, or 2 where all θ_i are 1/2.
class Staggered final : public DiscretizationMap {
 public:
  // Throws std::invalid_argument unless 0 ≤ θ_i ≤ 1, one for each coordinate, and frames of M are the identity.
  Staggered(std::shared_ptr<const Manifold> manifold, VectorXd theta);

  int order() const override { return is_symmetric() ? 2 : 1; }
  double stage_time() const override { return is_symmetric() ? 0.5 : 0.0; }
  bool is_symmetric() const override { return (theta_.array() == 0.5).all(); }

 private:
  PointPair<Expr> do_forward(const ExprVector& x, const ExprVector& v) const override;
  TangentVector<Expr> do_inverse(const ExprVector& x0, const ExprVector& x1) const override;

  ExprVector between(const ExprVector& x0, const ExprVector& displacement) const;

  VectorXd theta_;
};

}  // namespace courant
