// The discretization map of the spherical midpoint method.
#pragma once

#include "courant/integrators/maps/discretization_map.hpp"
#include "courant/manifolds/sphere.hpp"

namespace courant {

// R_d(x, v) = (c x - v/2, c x + v/2), c = √(1 - ‖v‖²/4), on Sⁿ for ‖v‖ < 2, onto the pairs with
// x₀ ≠ -x₁: v is the chord itself. With s = x₀ + x₁ the inverse is (s/‖s‖, x₁ - x₀), not finite at
// x₀ = -x₁. Symmetric, of order 2, whatever retraction the sphere has.
//
// With the bivector v = x × α of S² the step is x₁ - x₀ = h s/‖s‖ × ∇H(s/‖s‖): it is symplectic,
// also on products of spheres, where it keeps the moment map Σ x_i of the rotations exactly.
// The map (2) of the paper (Chordal) has the factor ‖s‖/2 at the right, and does neither.
// Reference: R. McLachlan, K. Modin, O. Verdier, A minimal-variable symplectic integrator on
// spheres, Math. Comp. 86 (2017).
class SphericalMidpoint final : public DiscretizationMap {
 public:
  explicit SphericalMidpoint(std::shared_ptr<const Sphere> sphere);

  int order() const override { return 2; }
  bool is_symmetric() const override { return true; }
  double domain_radius() const override { return 2.0; }

 private:
  PointPair<Expr> do_forward(const ExprVector& x, const ExprVector& v) const override;
  TangentVector<Expr> do_inverse(const ExprVector& x0, const ExprVector& x1) const override;
  Displacement do_from_start(const ExprVector& x0, const ExprVector& w) const override;
};

}  // namespace courant
