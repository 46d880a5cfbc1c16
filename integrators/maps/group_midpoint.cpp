#include "courant/integrators/maps/group_midpoint.hpp"

namespace courant {

GroupMidpoint::GroupMidpoint(std::shared_ptr<const MatrixGroup> group, const GroupMap& map)
    : DiscretizationMap("GroupMidpoint(" + map.name + ")", group),
      radius_(map.midpoint_radius),
      by_map_(group->with(map)) {}

DiscretizationMap::PointPair<Expr> GroupMidpoint::do_forward(const ExprVector& x,
                                                             const ExprVector& v) const {
  return {by_map_->retract(x, ExprVector(Expr(-0.5) * v)),
          by_map_->retract(x, ExprVector(Expr(0.5) * v))};
}

DiscretizationMap::Displacement GroupMidpoint::do_from_start(const ExprVector& x0,
                                                             const ExprVector& w) const {
  const ExprVector x = by_map_->source(x0, ExprVector(Expr(-0.5) * w));
  return {x, w, by_map_->retract(x, ExprVector(Expr(0.5) * w))};
}

}  // namespace courant
