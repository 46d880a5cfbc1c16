#include "courant/core/algebra/affine_parts.hpp"

#include <algorithm>
#include <vector>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/subgraph.hpp"

namespace courant {
namespace {

enum Degree { constant, affine, nonlinear };

Degree degree_of(Op op, const Degree* operand, int count) {
  const Degree highest = count == 0 ? constant : *std::max_element(operand, operand + count);
  if (highest == constant) return constant;
  switch (op) {
    case Op::negate:
    case Op::add:
    case Op::subtract:
      return highest;
    case Op::multiply:
      return std::min(operand[0], operand[1]) == constant ? highest : nonlinear;
    case Op::divide:
      return operand[1] == constant ? highest : nonlinear;
    default:
      return nonlinear;
  }
}

}  // namespace

ExprVector with_affine_parts(const ExprVector& expressions, const ExprVector& varying) {
  const Subgraph subgraph(expressions);
  if (subgraph.graph().is_none()) return expressions;
  const Graph& graph = subgraph.graph();
  const auto node_at = [&](std::size_t at) { return graph.node(subgraph.nodes()[at]); };
  const auto operands_at = [&](std::size_t at, std::size_t* operand) {
    const Node node = node_at(at);
    const std::uint32_t nodes[] = {node.a, node.b, node.c};
    const int count = subgraph.operand_count(subgraph.nodes()[at]);
    for (int i = 0; i < count; ++i) operand[i] = subgraph.position(nodes[i]);
    return count;
  };

  std::vector<Degree> degrees(subgraph.size(), constant);
  for (const Expr& u : varying)
    if (subgraph.contains(u)) degrees[subgraph.position(u)] = affine;
  // What is affine and part of what is not, or asked for.
  std::vector<bool> ends(subgraph.size(), false);
  for (std::size_t at = 0; at < subgraph.size(); ++at) {
    std::size_t operand[3];
    Degree of_operand[3];
    const int count = operands_at(at, operand);
    for (int i = 0; i < count; ++i) of_operand[i] = degrees[operand[i]];
    if (count > 0) degrees[at] = degree_of(node_at(at).op, of_operand, count);
    if (degrees[at] != nonlinear) continue;
    for (int i = 0; i < count; ++i) ends[operand[i]] = of_operand[i] == affine;
  }
  for (const Expr& asked : expressions)
    if (!asked.is_constant() && degrees[subgraph.position(asked)] == affine)
      ends[subgraph.position(asked)] = true;

  std::vector<Expr> image(subgraph.size());
  std::vector<std::size_t> places;
  for (std::size_t at = 0; at < image.size(); ++at) {
    image[at] = graph.expression(subgraph.nodes()[at]);
    std::size_t operand[3];
    if (ends[at] && operands_at(at, operand) > 0) places.push_back(at);
  }
  ExprVector parts(std::ssize(places));
  for (std::size_t k = 0; k < places.size(); ++k) parts[static_cast<Index>(k)] = image[places[k]];
  ExprVector sums = substitute(parts, varying, ExprVector::Zero(varying.size()));
  const SparseExprMatrix slopes = jacobian(parts, varying);
  for (std::size_t k = 0; k < slopes.row.size(); ++k) {
    const Expr product = slopes.values[static_cast<Index>(k)] * varying[slopes.col[k]];
    Expr& sum = sums[slopes.row[k]];
    sum = sum.is_constant(0.0) ? product : Expr(sum + product);
  }
  for (std::size_t k = 0; k < places.size(); ++k) image[places[k]] = sums[static_cast<Index>(k)];

  for (std::size_t at = 0; at < image.size(); ++at) {
    if (degrees[at] != nonlinear) continue;
    std::size_t operand[3];
    const int count = operands_at(at, operand);
    const Node node = node_at(at);
    image[at] = apply(node.op, node.k, image[operand[0]], count > 1 ? image[operand[1]] : Expr(),
                      count > 2 ? image[operand[2]] : Expr());
  }
  ExprVector result = expressions;
  for (Expr& entry : result)
    if (!entry.is_constant()) entry = image[subgraph.position(entry)];
  return result;
}

}  // namespace courant
