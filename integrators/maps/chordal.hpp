// The symmetric discretization map of the sphere by chords.
#pragma once

#include "courant/integrators/maps/discretization_map.hpp"
#include "courant/manifolds/sphere.hpp"

namespace courant {

// R_d(x, v) = ((x - v/2)/‖x - v/2‖, (x + v/2)/‖x + v/2‖) on Sⁿ (equation (2) of the paper), for all
// tangent v, onto the pairs with x₀ ≠ -x₁. With s = x₀ + x₁ the inverse is
//   (s/‖s‖, 2 (x₁ - x₀)/‖s‖),  not finite at x₀ = -x₁.
// Symmetric, of order 2, whatever retraction the sphere has.
class Chordal final : public DiscretizationMap {
 public:
  explicit Chordal(std::shared_ptr<const Sphere> sphere);

  int order() const override { return 2; }
  bool is_symmetric() const override { return true; }

 private:
  PointPair<Expr> do_forward(const ExprVector& x, const ExprVector& v) const override;
  TangentVector<Expr> do_inverse(const ExprVector& x0, const ExprVector& x1) const override;
  Displacement do_from_start(const ExprVector& x0, const ExprVector& w) const override;
};

}  // namespace courant
