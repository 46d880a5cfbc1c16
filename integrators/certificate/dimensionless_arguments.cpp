#include "courant/integrators/certificate/dimensionless_arguments.hpp"

#include <algorithm>
#include <cmath>

#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/subgraph.hpp"

namespace courant {
namespace {

bool is_of_numbers(Op op) {
  switch (op) {
    case Op::exp:
    case Op::sin:
    case Op::cos:
    case Op::tan:
    case Op::asin:
    case Op::acos:
    case Op::atan:
    case Op::sinh:
    case Op::cosh:
    case Op::tanh:
      return true;
    default:
      return false;
  }
}

}  // namespace

DimensionlessArguments::DimensionlessArguments(const ImplicitSystem& system) {
  Graph graph;
  const ExprVector x = graph.variables("x", system.manifold()->ambient_dimension()),
                   v = graph.variables("v", system.manifold()->tangent_dimension()),
                   z = graph.variables("z", system.auxiliary_size());
  const Expr t = graph.variable("t");
  const Subgraph nodes(system.residual(x, v, z, t));
  std::vector<Expr> found;
  for (const std::uint32_t node : nodes.nodes())
    if (is_of_numbers(nodes.graph().node(node).op))
      found.push_back(nodes.graph().expression(nodes.graph().node(node).a));
  std::ranges::sort(found, {}, [](const Expr& a) { return a.node(); });
  found.erase(std::unique(found.begin(), found.end()), found.end());
  if (found.empty()) return;
  const ExprVector y = joined(x, v, z, ExprVector::Constant(1, t));
  values_ = Function("arguments", {{"y", y}},
                     Eigen::Map<const ExprVector>(found.data(), std::ssize(found)),
                     {.differentiate = {"y"}});
  are_there_ = true;
}

std::vector<DimensionlessArguments::Slope> DimensionlessArguments::slopes(const VectorXd& y) const {
  if (!are_there_) return {};
  VectorXd jacobian(values_.output_size() + values_.nonzeros());
  const double* in[] = {y.data()};
  values_.value_and_jacobian(in, jacobian.data());
  std::vector<Slope> result;
  for (std::size_t k = 0; k < values_.pattern_row().size(); ++k) {
    const double size = std::fabs(jacobian[values_.output_size() + static_cast<Index>(k)]);
    if (size > 0.0 && std::isfinite(size))
      result.push_back({values_.pattern_row()[k], values_.pattern_col()[k], size});
  }
  return result;
}

}  // namespace courant
