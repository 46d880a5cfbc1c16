#include "courant/extensions/petsc/equation_rows.hpp"

#include <algorithm>

namespace courant {

void EquationRows::put_into(Message& message) const {
  message.put(instructions);
  message.put(constants);
  message.put(equations);
  message.put(unknowns);
  message.put(parameters);
}

EquationRows EquationRows::taken_from(Message& message) {
  EquationRows rows;
  rows.instructions = message.take<Node>();
  rows.constants = message.take<double>();
  rows.equations = message.take<std::uint32_t>();
  rows.unknowns = message.take_one<Index>();
  rows.parameters = message.take_one<Index>();
  return rows;
}

Function EquationRows::compile(const std::string& name, const Backend& backend) const {
  const Graph graph;
  const ExprVector u = graph.variables("u", unknowns), p = graph.variables("p", parameters);
  std::vector<Expr> values;
  values.reserve(instructions.size());
  for (const Node& node : instructions) {
    const int count = arity(node.op);
    if (node.op == Op::constant)
      values.emplace_back(constants.at(node.a));
    else if (node.op == Op::variable)
      values.push_back((node.a == 0 ? u : p)[static_cast<Index>(node.b)]);
    else if (count == 1)
      values.push_back(graph.make(node.op, node.k, values.at(node.a)));
    else if (count == 2)
      values.push_back(graph.make(node.op, node.k, values.at(node.a), values.at(node.b)));
    else
      values.push_back(
          graph.make(node.op, node.k, values.at(node.a), values.at(node.b), values.at(node.c)));
  }
  ExprVector outputs(std::ssize(equations));
  for (Index i = 0; i < outputs.size(); ++i)
    outputs[i] = values.at(equations[static_cast<std::size_t>(i)]);
  return Function(name, {{"u", u}, {"p", p}}, outputs,
                  {.differentiate = {"u"}, .backend = backend});
}

DividedEquations::DividedEquations(const std::vector<Function::Input>& inputs,
                                   const ExprVector& equations)
    : equations_(equations) {
  for (const Expr& equation : equations)
    if (!equation.is_constant()) graph_ = equation.graph();
  for (std::size_t g = 0; g < inputs.size(); ++g)
    for (Index i = 0; i < inputs[g].variables.size(); ++i)
      variables_.emplace(inputs[g].variables[i].node(), std::pair(static_cast<Index>(g), i));
  seen_.assign(graph_.is_none() ? 0 : graph_.size(), 0);
  std::vector<Index> contained;
  for (Index i = 0; i < equations_.size(); ++i) {
    contained.clear();
    for (const std::uint32_t node : nodes_of({i}))
      if (graph_.node(node).op == Op::variable)
        if (const auto [group, place] = variables_.at(node); group == 0) contained.push_back(place);
    std::ranges::sort(contained);
    for (const Index place : contained) pattern_.push_back({i, place});
  }
}

std::vector<std::uint32_t> DividedEquations::nodes_of(const std::vector<Index>& equations) const {
  ++search_;
  std::vector<std::uint32_t> nodes, open;
  const auto visit = [&](std::uint32_t node) {
    if (seen_[node] == search_) return;
    seen_[node] = search_;
    open.push_back(node);
  };
  for (const Index i : equations) {
    if (!equations_[i].is_constant()) visit(equations_[i].node());
    while (!open.empty()) {
      const std::uint32_t at = open.back();
      open.pop_back();
      nodes.push_back(at);
      const Node& node = graph_.node(at);
      const std::uint32_t operands[] = {node.a, node.b, node.c};
      for (int k = 0; k < arity(node.op); ++k) visit(operands[k]);
    }
  }
  std::ranges::sort(nodes);  // operands have smaller numbers
  return nodes;
}

DividedEquations::Part DividedEquations::part(const std::vector<Index>& equations,
                                              const std::vector<Index>& unknowns) const {
  Part part;
  EquationRows& rows = part.rows;
  std::unordered_map<Index, std::uint32_t> places;  // of unknowns, in the u of the part
  for (std::size_t k = 0; k < unknowns.size(); ++k)
    places.emplace(unknowns[k], static_cast<std::uint32_t>(k));
  const std::vector<std::uint32_t> nodes = nodes_of(equations);
  const auto number = [&](std::uint32_t node) {
    return static_cast<std::uint32_t>(std::ranges::lower_bound(nodes, node) - nodes.begin());
  };
  rows.instructions.reserve(nodes.size());
  for (const std::uint32_t at : nodes) {
    Node node = graph_.node(at);
    if (node.op == Op::constant) {
      node.a = static_cast<std::uint32_t>(rows.constants.size());
      rows.constants.push_back(graph_.constant(at));
    } else if (node.op == Op::variable) {
      const auto [group, place] = variables_.at(at);
      node.a = group == 0 ? 0 : 1;
      if (group == 0) {
        const auto [found, is_ghost] =
            places.emplace(place, static_cast<std::uint32_t>(places.size()));
        if (is_ghost) part.ghosts.push_back(place);
        node.b = found->second;
      } else {
        node.b = static_cast<std::uint32_t>(part.parameters.size());
        part.parameters.push_back({group, place});
      }
    } else {
      std::uint32_t* const operands[] = {&node.a, &node.b, &node.c};
      for (int k = 0; k < arity(node.op); ++k) *operands[k] = number(*operands[k]);
    }
    rows.instructions.push_back(node);
  }
  for (const Index i : equations) {
    if (equations_[i].is_constant()) {
      rows.equations.push_back(static_cast<std::uint32_t>(rows.instructions.size()));
      rows.instructions.push_back({.op = Op::constant,
                                   .k = 0,
                                   .a = static_cast<std::uint32_t>(rows.constants.size()),
                                   .b = 0,
                                   .c = 0});
      rows.constants.push_back(equations_[i].value());
    } else {
      rows.equations.push_back(number(equations_[i].node()));
    }
  }
  rows.unknowns = std::ssize(places);
  rows.parameters = std::ssize(part.parameters);
  return part;
}

}  // namespace courant
