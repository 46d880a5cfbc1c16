#include "courant/integrators/maps/projected.hpp"

#include <stdexcept>

namespace courant {
namespace {

const DiscretizationMap& checked(const std::shared_ptr<const ImplicitSubmanifold>& submanifold,
                                 const std::shared_ptr<const DiscretizationMap>& map) {
  if (!submanifold || !map)
    throw std::invalid_argument(std::string("Projected::Projected: ") +
                                (submanifold ? "surrounding_map" : "submanifold") + " is null.");
  if (*map->manifold() != *submanifold->surrounding())
    throw std::invalid_argument("Projected::Projected: surrounding_map is " + map->name() + " on " +
                                map->manifold()->name() + "; expected a map on the surrounding " +
                                "manifold of " + submanifold->name() + ", " +
                                submanifold->surrounding()->name() + ".");
  return *map;
}

}  // namespace

Projected::Projected(std::shared_ptr<const ImplicitSubmanifold> submanifold,
                     std::shared_ptr<const DiscretizationMap> surrounding_map)
    : DiscretizationMap("Projected(" + checked(submanifold, surrounding_map).name() + ")",
                        submanifold),
      submanifold_(std::move(submanifold)),
      map_(std::move(surrounding_map)) {}

DiscretizationMap::PointPair<Expr> Projected::do_forward(const ExprVector& x,
                                                         const ExprVector& v) const {
  const auto [first, second] = map_->forward(x, v);
  return {submanifold_->projection(first), submanifold_->projection(second)};
}

}  // namespace courant
