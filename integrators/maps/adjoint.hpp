// The adjoint of a discretization map.
#pragma once

#include "courant/integrators/maps/discretization_map.hpp"

namespace courant {

// R_d*(x, v) = (R⁺(x, -v), R⁻(x, -v)): the map whose method, with step h, undoes that of R_d with
// step -h. The adjoint of a symmetric map is that map; order, inverse and symplecticity are those
// of R_d. The stage, seen from the other end, is at 1 - stage_time().
class Adjoint final : public DiscretizationMap {
 public:
  // Throws std::invalid_argument if map is null.
  explicit Adjoint(std::shared_ptr<const DiscretizationMap> map);

  bool has_inverse() const override { return map_->has_inverse(); }
  double domain_radius() const override { return map_->domain_radius(); }
  int order() const override { return map_->order(); }
  double stage_time() const override { return 1.0 - map_->stage_time(); }
  bool is_symmetric() const override { return map_->is_symmetric(); }
  bool is_left_invariant() const override { return map_->is_left_invariant(); }
  std::optional<bool> is_symplectic() const override { return map_->is_symplectic(); }

 private:
  PointPair<Expr> do_forward(const ExprVector& x, const ExprVector& v) const override;
  TangentVector<Expr> do_inverse(const ExprVector& x0, const ExprVector& x1) const override;

  std::shared_ptr<const DiscretizationMap> map_;
};

}  // namespace courant
