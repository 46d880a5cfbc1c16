// The flat torus.
#pragma once

#include "courant/manifolds/manifold.hpp"

namespace courant {

// Tⁿ = Rⁿ/(2πZ)ⁿ by n angles; n ≥ 0. Points, tangent vectors and covectors have n entries.
//
// Points have many representatives: x and x + 2πk are the same, separation() measures modulo 2π,
// and no function may depend on which is given. retract adds, without wrapping, so that an angle
// counts its turns; inverse_retract gives the representative of y - x in (-π, π]ⁿ, smooth unless an
// angle differs by π. Every law of Manifold holds for ‖v‖ < π; geodesic.
class Torus final : public Manifold {
 public:
  explicit Torus(Index dimension);
  bool is_geodesic() const override { return true; }

 private:
  bool do_equals(const Manifold& other) const override { return other.name() == name(); }
  ExprVector do_retract(const ExprVector& x, const ExprVector& v) const override { return x + v; }
  ExprVector do_inverse_retract(const ExprVector& x, const ExprVector& y) const override;
  std::optional<VectorXd> do_unit() const override { return VectorXd::Zero(dimension()); }
  ScalingSymmetries do_scaling_symmetries() const override;
  ExprVector do_velocity_along(const ExprVector&, const ExprVector& v, const Expr&) const override {
    return v;
  }
  bool do_has_identity_frame() const override { return true; }
  ExprMatrix do_frame(const ExprVector& x) const override;
  ExprMatrix do_coframe(const ExprVector& x) const override { return do_frame(x); }
  double do_separation(const VectorXd& x, const VectorXd& y) const override;
  double do_injectivity_radius(const VectorXd& x) const override;
  VectorXd do_random_point(std::mt19937& generator) const override;
};

}  // namespace courant
