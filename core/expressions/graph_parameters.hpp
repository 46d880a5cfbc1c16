// Parameters of formulas, which a graph may have as variables.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "courant/core/expressions/expr.hpp"

namespace courant {

// A named number of a formula, such as the length of a pendulum.
//
// It is a constant of everything that is traced, with one exception: in a graph that was given parameters of
// this name by add_parameters() it is that variable, so that derivatives by it are exact. Formulas
// ask for it where they are traced:
//
//   const Expr l = Parameter{"l", 1.2}.at(x);    1.2, or the variable of the graph of x
struct Parameter {
  std::string name;
  double value = 0.0;

  // In the graph of the first entry of x that is no constant; the value where there is none.
  Expr at(const ExprVector& x) const;
};

// The parameters of a new graph, as variables: its first ones. Throws std::invalid_argument if it has nodes
// already.
ExprVector add_parameters(const Graph& graph, const std::vector<std::string>& names);

// Those of a graph; none of Graph::none().
std::vector<std::string> parameter_names(const Graph& graph);
// Whether a node is one of them, and the name of a variable as formulas write it.
bool is_parameter(const Graph& graph, std::uint32_t node);
std::string written_name(const Graph& graph, std::uint32_t node);
// The parameter of this name; the constant `otherwise` where the graph has none.
Expr parameter_of(const Graph& graph, const std::string& name, const Expr& otherwise);

// That of the first entry that is no constant; Graph::none().
Graph graph_of(const ExprVector& x);

// A new graph with the parameters of these expressions: for formulas that are differentiated at fresh
// variables. substitute() brings its parameters to those of the graph that it leads to.
Graph fresh_graph(std::initializer_list<ExprVector> like);

}  // namespace courant
