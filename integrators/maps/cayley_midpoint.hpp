// The midpoint discretization map of the Cayley transform, on SO(3) and SE(3).
#pragma once

#include "courant/integrators/maps/discretization_map.hpp"
#include "courant/manifolds/special_euclidean3.hpp"
#include "courant/manifolds/special_orthogonal.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"

namespace courant {

// R_d(x, v) = (x cay(-v/2), x cay(v/2)), cay ξ = (1 - ξ/2)⁻¹(1 + ξ/2), on SO(3), SE(3) or SO(n),
// whatever retraction the group has. Rational; symmetric, of order 2.
//
// The inverse halves: with x₀⁻¹x₁ = cay(v/2)² and (c, s) the quaternion of its rotation (angle φ,
// c = cos φ/2), the rotational part of v is ω = 4 s/(1 + c) = 4 tan(φ/4) axis, the translational
// one u = (1 - ω̂/4)² r with r the translation of x₀⁻¹x₁; and x = x₀ cay(v/2). Right for ‖ω‖ < 4,
// that is φ < π; beyond, x₀ and x₁ are also reached the short way round, and that is the inverse
// given. On SO(n) the root has no closed formula, but from_start needs none.
class CayleyMidpoint final : public DiscretizationMap {
 public:
  explicit CayleyMidpoint(std::shared_ptr<const SpecialOrthogonal3> group);
  explicit CayleyMidpoint(std::shared_ptr<const SpecialEuclidean3> group);
  explicit CayleyMidpoint(std::shared_ptr<const SpecialOrthogonal> group);

  bool has_inverse() const override { return has_root_; }
  bool has_start() const override { return true; }
  // On SO(n) an eigenvalue i λ of V, |λ| ≤ ‖v‖, turns by 4 atan(λ/4): by less than π.
  double domain_radius() const override {
    return has_root_ ? DiscretizationMap::domain_radius() : 4.0;
  }
  int order() const override { return 2; }
  bool is_symmetric() const override { return true; }
  bool is_left_invariant() const override { return true; }

 private:
  PointPair<Expr> do_forward(const ExprVector& x, const ExprVector& v) const override;
  TangentVector<Expr> do_inverse(const ExprVector& x0, const ExprVector& x1) const override;
  Displacement do_from_start(const ExprVector& x0, const ExprVector& w) const override;

  bool has_root_ = true;
  std::shared_ptr<const Manifold> cayley_;  // the same group, with the Cayley retraction
};

}  // namespace courant
