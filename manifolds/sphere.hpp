// The unit sphere.
#pragma once

#include "courant/manifolds/manifold.hpp"
#include "courant/manifolds/retraction.hpp"

namespace courant {

// Sⁿ = {x ∈ Rⁿ⁺¹ : ‖x‖ = 1}; n ≥ 0 is the dimension of the sphere, so Sphere(2) is S² ⊂ R³.
//
//   point x ∈ Rⁿ⁺¹,   tangent v ∈ Rⁿ⁺¹ with ⟨x, v⟩ = 0,   covector α ∈ Rⁿ⁺¹ with ⟨x, α⟩ = 0
//   E(x) = C(x) = Π(x) = 1 - x xᵀ
//
// Retractions:
//   exponential()  R_x(v) = cos‖v‖ x + sin‖v‖/‖v‖ v, geodesic (Example 5.3); injective for ‖v‖ < π;
//                  inverse θ/sin θ (y - cos θ x), θ = arccos⟨x, y⟩, for y ≠ -x
//   projective()   R_x(v) = (x + v)/‖x + v‖ for all v, onto the half ⟨x, y⟩ > 0;
//                  inverse y/⟨x, y⟩ - x
//
// Outside, the inverse of the exponential retraction is not a number at y = -x, and that of the
// projective one is not the inverse at ⟨x, y⟩ ≤ 0.
class Sphere final : public Manifold {
 public:
  // Throws std::invalid_argument unless dimension ≥ 0.
  explicit Sphere(Index dimension, Retraction retraction = exponential());

  static Retraction exponential();
  static Retraction projective();

  bool is_geodesic() const override { return retraction_.is_geodesic; }

 private:
  bool do_equals(const Manifold& other) const override { return other.name() == name(); }
  ExprVector do_retract(const ExprVector& x, const ExprVector& v) const override;
  ExprVector do_inverse_retract(const ExprVector& x, const ExprVector& y) const override;
  ExprVector do_velocity_along(const ExprVector& x, const ExprVector& v,
                               const Expr& s) const override;
  ExprMatrix do_frame(const ExprVector& x) const override;
  ExprMatrix do_coframe(const ExprVector& x) const override { return do_frame(x); }
  ExprVector do_constraint(const ExprVector& x) const override;
  double do_injectivity_radius(const VectorXd& x) const override;
  VectorXd do_project(const VectorXd& x) const override;

  Retraction retraction_;
};

}  // namespace courant
