#include "courant/structures/circuit_graph.hpp"

#include <algorithm>
#include <utility>

namespace courant {

void add_edge(std::size_t source, std::size_t target, CircuitElement element, CircuitGraph& graph) {
  graph.node_count = std::max({graph.node_count, source + 1, target + 1});
  graph.edges.push_back({source, target, std::move(element)});
}

void add_edge(std::size_t source, std::size_t target, CircuitGraph& graph) {
  add_edge(source, target, CircuitElement{}, graph);
}

}  // namespace courant
