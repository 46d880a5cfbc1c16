#include "courant/integrators/maps/adjoint.hpp"

#include <stdexcept>

namespace courant {
namespace {

const DiscretizationMap& checked(const std::shared_ptr<const DiscretizationMap>& map) {
  if (!map)
    throw std::invalid_argument("Adjoint::Adjoint: map is null; expected a discretization map.");
  return *map;
}

}  // namespace

Adjoint::Adjoint(std::shared_ptr<const DiscretizationMap> map)
    : DiscretizationMap("Adjoint(" + checked(map).name() + ")", checked(map).manifold()),
      map_(std::move(map)) {}

DiscretizationMap::PointPair<Expr> Adjoint::do_forward(const ExprVector& x,
                                                       const ExprVector& v) const {
  auto [first, second] = map_->forward(x, ExprVector(-v));
  return {std::move(second), std::move(first)};
}

DiscretizationMap::TangentVector<Expr> Adjoint::do_inverse(const ExprVector& x0,
                                                           const ExprVector& x1) const {
  auto [x, v] = map_->inverse(x1, x0);
  return {std::move(x), -v};
}

}  // namespace courant
