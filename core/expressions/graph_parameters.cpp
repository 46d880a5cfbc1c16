#include "courant/core/expressions/graph_parameters.hpp"

#include <stdexcept>
#include <string_view>

namespace courant {
namespace {

// No variable of a formula has a name with a space in it.
const std::string kMark = "parameter ";

}  // namespace

bool is_parameter(const Graph& graph, std::uint32_t node) {
  return node < graph.size() && graph.node(node).op == Op::variable &&
         graph.name(node).starts_with(kMark);
}

std::string written_name(const Graph& graph, std::uint32_t node) {
  const std::string& name = graph.name(node);
  return is_parameter(graph, node) ? name.substr(kMark.size()) : name;
}

ExprVector add_parameters(const Graph& graph, const std::vector<std::string>& names) {
  if (graph.size() > 0)
    throw std::invalid_argument("add_parameters: the graph has " + std::to_string(graph.size()) +
                                " nodes; expected a new one.");
  ExprVector result(static_cast<Index>(names.size()));
  for (Index i = 0; i < result.size(); ++i)
    result[i] = graph.variable(kMark + names[static_cast<std::size_t>(i)]);
  return result;
}

std::vector<std::string> parameter_names(const Graph& graph) {
  std::vector<std::string> names;
  if (graph.is_none()) return names;
  for (std::uint32_t node = 0; is_parameter(graph, node); ++node)
    names.push_back(graph.name(node).substr(kMark.size()));
  return names;
}

Expr parameter_of(const Graph& graph, const std::string& name, const Expr& otherwise) {
  if (graph.is_none()) return otherwise;
  for (std::uint32_t node = 0; is_parameter(graph, node); ++node)
    if (std::string_view(graph.name(node)).substr(kMark.size()) == name)
      return graph.expression(node);
  return otherwise;
}

Expr Parameter::at(const ExprVector& x) const { return parameter_of(graph_of(x), name, value); }

Graph graph_of(const ExprVector& x) {
  for (const Expr& entry : x)
    if (!entry.is_constant()) return entry.graph();
  return Graph::none();
}

Graph fresh_graph(std::initializer_list<ExprVector> like) {
  Graph graph;
  for (const ExprVector& x : like)
    if (const Graph of = graph_of(x); !of.is_none()) {
      add_parameters(graph, parameter_names(of));
      break;
    }
  return graph;
}

}  // namespace courant
