// The part of a graph that some expressions are made of.
#pragma once

#include <cstdint>
#include <vector>

#include "courant/core/expr.hpp"

namespace courant {

// The nodes that the roots are made of, in topological order and numbered 0, 1, 2, … in it, so that
// an algorithm on a few expressions of a large graph keeps a few numbers, not one for each node of
// the graph.
class Subgraph {
 public:
  // Throws std::invalid_argument if the roots are of two graphs.
  explicit Subgraph(const ExprVector& roots);

  const Graph& graph() const { return graph_; }  // Graph::none() if all roots are constant
  std::size_t size() const { return nodes_.size(); }

  // The node numbers, ascending: operands come before results.
  const std::vector<std::uint32_t>& nodes() const { return nodes_; }

  // Whether a is one of the nodes; constants are not.
  bool contains(const Expr& a) const;

  // i with nodes()[i] = node, for a node that is contained.
  std::size_t position(std::uint32_t node) const;
  std::size_t position(const Expr& a) const { return position(a.node()); }

 private:
  Graph graph_ = Graph::none();
  std::vector<std::uint64_t> members_;  // one bit a node
  std::vector<std::uint32_t> before_;   // number of members in the words before this one
  std::vector<std::uint32_t> nodes_;
};

}  // namespace courant
