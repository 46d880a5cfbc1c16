// The rotation group of R³.
#pragma once

#include "courant/manifolds/manifold.hpp"
#include "courant/manifolds/retraction.hpp"

namespace courant {

// SO(3) = {R ∈ R^{3×3} : RᵀR = 1, det R = 1}, left-trivialised.
//
//   point      R ∈ R⁹, row after row: R[i][j] = x[3i+j]         N = 9
//   tangent    v ∈ R³ with Ṙ = R v̂, the angular velocity in the body      n = Ñ = 3
//   covector   in (R³)*, the angular momentum in the body
//   frame      E v = R v̂,   C Ṙ = (RᵀṘ)^∨ of the skew part
//
// Retractions:
//   exponential()  R exp v̂, geodesic (Example 4.10); injective for ‖v‖ < π
//   cayley()       R cay v̂, cay v̂ = (1 - v̂/2)⁻¹(1 + v̂/2): rational, injective for all v
// Both miss the rotations of R by π, where the inverses are not smooth (exponential) or not finite
// (Cayley).
class SpecialOrthogonal3 final : public Manifold {
 public:
  explicit SpecialOrthogonal3(Retraction retraction = exponential());

  static Retraction exponential();
  static Retraction cayley();

  bool is_geodesic() const override { return retraction_.is_geodesic; }

 private:
  bool do_equals(const Manifold& other) const override { return other.name() == name(); }
  ExprVector do_retract(const ExprVector& x, const ExprVector& v) const override;
  ExprVector do_inverse_retract(const ExprVector& x, const ExprVector& y) const override;
  std::optional<VectorXd> do_unit() const override;
  ExprVector do_velocity_along(const ExprVector& x, const ExprVector& v,
                               const Expr& s) const override;
  ExprMatrix do_frame(const ExprVector& x) const override;
  ExprMatrix do_coframe(const ExprVector& x) const override;
  ExprVector do_constraint(const ExprVector& x) const override;
  double do_injectivity_radius(const VectorXd& x) const override;
  VectorXd do_project(const VectorXd& x) const override;
  VectorXd do_random_point(std::mt19937& generator) const override;

  Retraction retraction_;
};

}  // namespace courant
