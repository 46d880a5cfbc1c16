// CircuitGraph: which elements connect which nodes.
#pragma once

#include <boost/graph/adjacency_list.hpp>
#include <string>

namespace courant {

// A vertex of the graph of a circuit.
struct CircuitNode {
  std::string name;
};

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
using CircuitGraph = boost::adjacency_list<boost::vecS, boost::vecS, boost::bidirectionalS,
                                           CircuitNode, CircuitElement>;

}  // namespace courant
