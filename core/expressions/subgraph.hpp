// The part of a graph that some expressions are made of.
#pragma once

#include <cstdint>
#include <vector>

#include "courant/core/expressions/expr.hpp"

namespace courant {

// The nodes that the roots are made of, in topological order and numbered 0, 1, 2, … in it, so that
// an algorithm on a few expressions of a large graph keeps a few numbers, not one for each node of
// the graph.
class Subgraph {
 public:
  // Throws std::invalid_argument if the roots are of two graphs.
  explicit Subgraph(const ExprVector& roots) : Subgraph(roots, ExprVector(0)) {}
  // The same down to the leaves, whose operands do not belong to it. Leaves are nodes of the same graph.
  Subgraph(const ExprVector& roots, const ExprVector& leaves);

  const Graph& graph() const { return graph_; }  // Graph::none() if all roots are constant
  std::size_t size() const { return nodes_.size(); }

  // The node numbers, ascending: operands come before results.
  const std::vector<std::uint32_t>& nodes() const { return nodes_; }

  // Of a node that is contained: how many operands it has here. A leaf has none.
  int operand_count(std::uint32_t node) const {
    return is_leaf(node) ? 0 : arity(graph_.node(node).op);
  }

  // Whether a is one of the nodes; constants are not.
  bool contains(const Expr& a) const;

  // i with nodes()[i] = node, for a node that is contained.
  std::size_t position(std::uint32_t node) const;
  std::size_t position(const Expr& a) const { return position(a.node()); }

 private:
  bool is_leaf(std::uint32_t node) const {
    return node / 64 < leaves_.size() && (leaves_[node / 64] >> (node % 64) & 1) != 0;
  }

  Graph graph_ = Graph::none();
  std::vector<std::uint64_t> leaves_;   // one bit a node
  std::vector<std::uint64_t> members_;  // one bit a node
  std::vector<std::uint32_t> before_;   // number of members in the words before this one
  std::vector<std::uint32_t> nodes_;
};

// Of each node, by its position, whether a variable of `varying` is in it.
std::vector<bool> contains_any(const Subgraph& subgraph, const ExprVector& varying);

// Those of some groups of variables that the expressions contain a variable of, ascending.
std::vector<Index> contained_groups(const ExprVector& expressions,
                                    const std::vector<ExprVector>& groups);

}  // namespace courant
