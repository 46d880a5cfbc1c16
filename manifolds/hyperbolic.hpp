// Hyperbolic space.
#pragma once

#include "courant/manifolds/manifold.hpp"

namespace courant {

// Hⁿ, the upper sheet of the hyperboloid {x ∈ Rⁿ⁺¹ : ⟨x, x⟩_L = -1, x[0] > 0} with the Lorentz
// product ⟨x, y⟩_L = -x[0] y[0] + x[1] y[1] + … + x[n] y[n]; n ≥ 0.
//
//   point x ∈ Rⁿ⁺¹,   tangent v with ⟨x, v⟩_L = 0,   covector α with α(x) = 0
//   E(x) = C(x) = Π(x) = 1 + x (Jx)ᵀ,  J = diag(-1, 1, …, 1);   not symmetric
//
// R_x(v) = cosh‖v‖_L x + sinh‖v‖_L/‖v‖_L v, geodesic, a diffeomorphism of T_xM onto Hⁿ. Its inverse
// is θ/sinh θ (y - cosh θ x), cosh θ = -⟨x, y⟩_L. Coordinates grow like exp of the distance from
// (1, 0, …), and with them the round-off.
class Hyperbolic final : public Manifold {
 public:
  explicit Hyperbolic(Index dimension);
  bool is_geodesic() const override { return true; }

 private:
  bool do_equals(const Manifold& other) const override { return other.name() == name(); }
  ExprVector do_retract(const ExprVector& x, const ExprVector& v) const override;
  ExprVector do_inverse_retract(const ExprVector& x, const ExprVector& y) const override;
  ExprMatrix do_frame(const ExprVector& x) const override;
  ExprMatrix do_coframe(const ExprVector& x) const override { return do_frame(x); }
  ExprVector do_constraint(const ExprVector& x) const override;
  VectorXd do_project(const VectorXd& x) const override;
};

}  // namespace courant
