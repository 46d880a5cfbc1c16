#include "courant/core/solve/exponentials.hpp"

#include <algorithm>
#include <cmath>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/subgraph.hpp"

namespace courant {
namespace {

// Changes of an argument that an exponential follows well enough by its tangent.
constexpr double kSmallChange = 1.0;

// The arguments of exp, sinh and cosh that change with some unknowns, and the equations with variables in
// their places.
struct Arguments {
  Arguments(const ExprVector& equations, const ExprVector& unknowns) {
    const Subgraph part(equations);
    if (part.graph().is_none()) return;
    const Graph graph = part.graph();
    std::vector<std::uint32_t> candidates;
    for (const std::uint32_t node : part.nodes()) {
      const Op op = graph.node(node).op;
      if (op == Op::exp || op == Op::sinh || op == Op::cosh) candidates.push_back(node);
    }
    std::vector<Expr> of;
    for (const std::uint32_t node : candidates) of.push_back(graph.expression(graph.node(node).a));
    const std::vector<bool> moves =
        each_depends(Eigen::Map<const ExprVector>(of.data(), std::ssize(of)), unknowns);
    std::vector<std::ptrdiff_t> number(part.size(), -1);  // of an argument, by its place
    std::vector<Expr> found;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      if (!moves[k]) continue;
      std::ptrdiff_t& at = number[part.position(of[k])];
      if (at < 0) {
        at = std::ssize(found);
        found.push_back(of[k]);
        both_ways.push_back(false);
      }
      if (graph.node(candidates[k]).op != Op::exp) both_ways[static_cast<std::size_t>(at)] = true;
    }
    values = Eigen::Map<const ExprVector>(found.data(), std::ssize(found));
    held = graph.variables("held", values.size());
    std::vector<Expr> image(part.size());
    for (std::size_t at = 0; at < part.size(); ++at) {
      if (number[at] >= 0) {
        image[at] = held[number[at]];
        continue;
      }
      const std::uint32_t index = part.nodes()[at];
      const Node& node = graph.node(index);
      const int count = arity(node.op);
      const auto operand = [&](int i, std::uint32_t of_node) {
        return i < count ? image[part.position(of_node)] : Expr();
      };
      image[at] = count == 0 ? graph.expression(index)
                             : apply(node.op, node.k, operand(0, node.a), operand(1, node.b),
                                     operand(2, node.c));
    }
    with_held = equations;
    for (Expr& entry : with_held)
      if (!entry.is_constant()) entry = image[part.position(entry)];
  }

  ExprVector values, held, with_held;
  std::vector<bool> both_ways;
};

}  // namespace

ExprVector exponential_arguments(const ExprVector& equations, const ExprVector& unknowns) {
  return Arguments(equations, unknowns).values;
}

Exponentials::Exponentials(const std::string& name, const std::vector<Function::Input>& inputs,
                           const ExprVector& equations) {
  const ExprVector& y = inputs.at(0).variables;
  Arguments found(equations, y);
  if (found.values.size() == 0) return;
  grows_both_ways_ = std::move(found.both_ways);
  arguments_ = Function(name + ", arguments of exponentials", inputs, found.values);
  std::vector<Function::Input> with_held = inputs;
  with_held.push_back({"held", found.held});
  linearized_ =
      Function(name + ", exponentials linearised", with_held,
               found.with_held + tangent(found.with_held, found.held, found.values - found.held),
               {.differentiate = {inputs[0].name}});
}

void Exponentials::move(VectorXd& held, const VectorXd& arguments) const {
  for (Index k = 0; k < held.size(); ++k) {
    const double sign =
        grows_both_ways_[static_cast<std::size_t>(k)] && arguments[k] < 0.0 ? -1.0 : 1.0;
    const double from = std::max(sign * held[k], 0.0), to = sign * arguments[k];
    held[k] = to - from <= kSmallChange ? arguments[k] : sign * (from + std::log1p(to - from));
  }
}

}  // namespace courant
