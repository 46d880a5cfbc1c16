// The theta family of discretization maps.
#pragma once

#include "courant/integrators/maps/discretization_map.hpp"

namespace courant {

// R_d(x, v) = (R_x(-θ v), R_x((1-θ) v)) with the retraction R of the manifold, θ ∈ [0, 1]
// (Examples 4.8, 4.9, 4.10).
//
// θ = 0: explicit Euler; θ = ½: the implicit midpoint rule on Rⁿ, symmetric, order 2 on any
// manifold; θ = 1: implicit Euler. The inverse is closed if the retraction has one and is geodesic
// or θ is 0 or 1. The pairs that begin at a point also are if the retraction is geodesic or has
// sources, as on groups.
class Theta final : public DiscretizationMap {
 public:
  // Throws std::invalid_argument unless 0 ≤ θ ≤ 1.
  explicit Theta(std::shared_ptr<const Manifold> manifold, double theta = 0.5);

  double theta() const { return theta_; }
  bool has_inverse() const override;
  bool has_start() const override {
    return has_inverse() || theta_ == 0.0 || manifold()->is_geodesic() || manifold()->has_source();
  }
  int order() const override { return theta_ == 0.5 ? 2 : 1; }
  double stage_time() const override { return theta_; }
  bool is_symmetric() const override { return theta_ == 0.5; }
  bool is_left_invariant() const override { return manifold()->unit().has_value(); }

 private:
  PointPair<Expr> do_forward(const ExprVector& x, const ExprVector& v) const override;
  TangentVector<Expr> do_inverse(const ExprVector& x0, const ExprVector& x1) const override;
  Displacement do_from_start(const ExprVector& x0, const ExprVector& w) const override;

  double theta_;
};

}  // namespace courant
