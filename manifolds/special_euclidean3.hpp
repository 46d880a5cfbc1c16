// The group of rigid motions of R³.
#pragma once

#include "courant/manifolds/manifold.hpp"
#include "courant/manifolds/retraction.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"

namespace courant {

// SE(3) = {(R, r) : R ∈ SO(3), r ∈ R³} with (R, r)(S, s) = (RS, R s + r), left-trivialised.
//
//   point      (R, r) ∈ R¹², R row after row                    N = 12
//   tangent    (ω, u) ∈ R⁶ with Ṙ = R ω̂, ṙ = R u, the angular and linear velocity in the body
//   covector   in (R⁶)*, the angular and linear momentum in the body      n = Ñ = 6
//
// Retractions, x ↦ x τ(ω, u):
//   exponential()  τ = (exp ω̂, (1 + c₂ ω̂ + c₃ ω̂²) u), c_k(‖ω‖²) the Stumpff functions; geodesic;
//                  injective for ‖ω‖ < π
//   cayley()       τ = (1 - ξ/2)⁻¹(1 + ξ/2) = (cay ω̂, (1 - ω̂/2)⁻¹ u) with ξ = (ω̂ u; 0 0);
//                  injective for all (ω, u)
// Both miss the motions that turn by π, as on SpecialOrthogonal3.
class SpecialEuclidean3 final : public Manifold {
 public:
  explicit SpecialEuclidean3(Retraction retraction = exponential());

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

  SpecialOrthogonal3 rotations_;
  Retraction retraction_;
};

}  // namespace courant
