#include "courant/core/expressions/held_part.hpp"

#include <vector>

#include "courant/core/expressions/subgraph.hpp"

namespace courant {

ExprVector held_part(const ExprVector& outputs, const ExprVector& varying) {
  const Subgraph subgraph(outputs);
  const Graph& graph = subgraph.graph();
  const auto& nodes = subgraph.nodes();
  const std::vector<bool> varies = contains_any(subgraph, varying);
  std::vector<bool> is_held(nodes.size(), false);
  const auto hold = [&](std::size_t at) {
    if (!varies[at] && arity(graph.node(nodes[at]).op) > 0) is_held[at] = true;
  };
  for (std::size_t at = 0; at < nodes.size(); ++at) {
    const Node& node = graph.node(nodes[at]);
    const std::uint32_t operand[] = {node.a, node.b, node.c};
    for (int i = 0; varies[at] && i < arity(node.op); ++i) hold(subgraph.position(operand[i]));
  }
  for (const Expr& output : outputs)
    if (!output.is_constant()) hold(subgraph.position(output));

  std::vector<Expr> held;
  for (std::size_t at = 0; at < nodes.size(); ++at)
    if (is_held[at]) held.push_back(graph.expression(nodes[at]));
  return Eigen::Map<const ExprVector>(held.data(), static_cast<Index>(held.size()));
}

}  // namespace courant
