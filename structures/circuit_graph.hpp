// CircuitGraph: which elements connect which nodes.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace courant {

// An edge of the graph of a circuit.
struct CircuitElement {
  std::string name;
  // The spanning tree takes elements of little weight first. A normal tree of a circuit gives
  // voltage sources and capacitors less, inductors and current sources more than the others.
  double weight = 0.0;
};

// Nodes, and elements oriented from source to target: the current of an element counts positive
// from source to target, its voltage is the potential of the source less that of the target; so
// current times voltage flows into the element. Parallel elements, self-loops, isolated nodes and
// several components are allowed. Elements are numbered in the order in which they are added.
//
//   CircuitGraph graph(2);
//   add_edge(0, 1, CircuitElement{"C1"}, graph);
struct CircuitGraph {
  struct Edge {
    std::size_t source = 0, target = 0;
    CircuitElement element = {};
  };

  explicit CircuitGraph(std::size_t nodes) : node_count(nodes) {}

  std::size_t node_count;
  std::vector<Edge> edges = {};
};

// Adds an element. Nodes that the graph does not have yet are added up to the larger of these two.
void add_edge(std::size_t source, std::size_t target, CircuitElement element, CircuitGraph& graph);
void add_edge(std::size_t source, std::size_t target, CircuitGraph& graph);

}  // namespace courant
