// The discretization map of a submanifold that one of the surrounding manifold gives.
#pragma once

#include "courant/integrators/maps/discretization_map.hpp"
#include "courant/manifolds/implicit_submanifold.hpp"

namespace courant {

// R_d^S = (P × P) ∘ R_d ∘ Ti (Proposition 7.3) on S = {c = 0} ⊂ M, with a discretization map R_d of
// M, the inclusion i and P = ImplicitSubmanifold::projection.
//
// R⁻ and R⁺ lie on S to 1e-12 for ‖v‖ up to the injectivity radius of S, half its radius of
// curvature, where R_d strays from S no further than a straight line does; with the midpoint rule
// of R³ on the unit sphere they do up to ‖v‖ = 6. No closed inverse.
//
// Symmetric if R_d is: R⁺(x, v) = R⁻(x, -v) stays true under P. Of the order of R_d, 1 or 2: in
// coordinates R⁺ - R⁻ = v + O(‖v‖³) and R⁺ + R⁻ = 2x + O(‖v‖²) hold for P R^± too, since the second
// derivative of P adds as much to R⁺ as to R⁻. (Where R_d is asymmetric or of order 1 only across
// S, the claims are too modest.) System time is taken where R_d takes it.
class Projected final : public DiscretizationMap {
 public:
  // Throws std::invalid_argument if an argument is null or the map is not on submanifold's
  // surrounding() itself.
  Projected(std::shared_ptr<const ImplicitSubmanifold> submanifold,
            std::shared_ptr<const DiscretizationMap> surrounding_map);

  const std::shared_ptr<const DiscretizationMap>& surrounding_map() const { return map_; }  // R_d
  double domain_radius() const override { return map_->domain_radius(); }
  bool has_inverse() const override { return false; }
  int order() const override { return map_->order(); }
  double stage_time() const override { return map_->stage_time(); }
  bool is_symmetric() const override { return map_->is_symmetric(); }

 private:
  PointPair<Expr> do_forward(const ExprVector& x, const ExprVector& v) const override;

  std::shared_ptr<const ImplicitSubmanifold> submanifold_;
  std::shared_ptr<const DiscretizationMap> map_;
};

}  // namespace courant
