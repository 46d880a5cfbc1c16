// Euclidean space.
#pragma once

#include "courant/manifolds/manifold.hpp"

namespace courant {

// Rⁿ with R(x, v) = x + v (Remark 4.2). Points, tangent vectors and covectors have n entries; n ≥
// 0. Every law of Manifold holds everywhere, with an infinite injectivity radius.
class Euclidean final : public Manifold {
 public:
  explicit Euclidean(Index dimension);
  bool is_geodesic() const override { return true; }

 private:
  bool do_equals(const Manifold& other) const override { return other.name() == name(); }
  ExprVector do_retract(const ExprVector& x, const ExprVector& v) const override { return x + v; }
  ExprVector do_inverse_retract(const ExprVector& x, const ExprVector& y) const override {
    return y - x;
  }
  std::optional<VectorXd> do_unit() const override { return VectorXd::Zero(dimension()); }
  ScalingSymmetries do_scaling_symmetries() const override;
  ExprVector do_velocity_along(const ExprVector&, const ExprVector& v, const Expr&) const override {
    return v;
  }
  bool do_has_identity_frame() const override { return true; }
  ExprMatrix do_frame(const ExprVector& x) const override;
  ExprMatrix do_coframe(const ExprVector& x) const override;
};

}  // namespace courant
