#include "courant/structures/smooth_map.hpp"

#include <stdexcept>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/graph_parameters.hpp"
#include "courant/structures/structure_checks.hpp"

namespace courant {

namespace {

using ManifoldPointer = std::shared_ptr<const Manifold>;

}  // namespace

SmoothMap::SmoothMap(ManifoldPointer source, ManifoldPointer target, Formula formula)
    : source_(std::move(source)), target_(std::move(target)), formula_(std::move(formula)) {
  if (!source_ || !target_) throw std::invalid_argument("SmoothMap: a manifold is null.");
}

ExprVector SmoothMap::operator()(const ExprVector& x) const {
  require_equal("SmoothMap", "the size of x", x.size(), source_->ambient_dimension());
  ExprVector y = formula_(x);
  require_equal("SmoothMap", "the size of the value", y.size(), target_->ambient_dimension());
  return y;
}

ExprMatrix SmoothMap::tangent(const ExprVector& x) const {
  const Graph graph = fresh_graph({x});
  const ExprVector point = graph.variables("x", x.size());
  const ExprMatrix derivative = jacobian((*this)(point), point).dense();
  const ExprMatrix local = target_->coframe((*this)(point)) * (derivative * source_->frame(point));
  const ExprVector entries =
      substitute(ExprVector(Eigen::Map<const ExprVector>(local.data(), local.size())), point, x);
  return Eigen::Map<const ExprMatrix>(entries.data(), local.rows(), local.cols());
}

}  // namespace courant
