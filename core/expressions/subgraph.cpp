#include "courant/core/expressions/subgraph.hpp"

#include <algorithm>
#include <bit>
#include <stdexcept>

namespace courant {
namespace {

constexpr std::uint64_t bit(std::uint32_t node) { return std::uint64_t{1} << (node % 64); }

}  // namespace

Subgraph::Subgraph(const ExprVector& roots, const ExprVector& leaves) {
  std::uint32_t last = 0;
  for (const Expr& root : roots) {
    if (root.is_constant()) continue;
    if (graph_.is_none()) graph_ = root.graph();
    if (!(root.graph() == graph_))
      throw std::invalid_argument(
          "Subgraph: the expressions are of two graphs; expected one. Use substitute.");
    last = std::max(last, root.node());
  }
  if (graph_.is_none()) return;

  for (const Expr& leaf : leaves) {
    if (leaf.is_constant() || !(leaf.graph() == graph_))
      throw std::invalid_argument("Subgraph: a leaf is no node of the graph of the roots.");
    if (leaf.node() / 64 >= leaves_.size()) leaves_.resize(leaf.node() / 64 + 1, 0);
    leaves_[leaf.node() / 64] |= bit(leaf.node());
  }
  members_.assign(last / 64 + 1, 0);
  for (const Expr& root : roots)
    if (!root.is_constant()) members_[root.node() / 64] |= bit(root.node());

  // Downward through the numbers: operands have smaller ones, so a node is complete when it is met.
  std::size_t count = 0;
  for (std::size_t word = members_.size(); word-- > 0;) {
    std::uint64_t unseen = ~std::uint64_t{0};
    while (const std::uint64_t left = members_[word] & unseen) {
      const auto top = static_cast<std::uint32_t>(std::bit_width(left)) - 1;
      unseen = (std::uint64_t{1} << top) - 1;
      const std::uint32_t index = static_cast<std::uint32_t>(64 * word) + top;
      const Node& node = graph_.node(index);
      const std::uint32_t operand[] = {node.a, node.b, node.c};
      for (int i = 0; i < operand_count(index); ++i) members_[operand[i] / 64] |= bit(operand[i]);
      ++count;
    }
  }

  nodes_.reserve(count);
  before_.reserve(members_.size());
  for (std::size_t word = 0; word < members_.size(); ++word) {
    before_.push_back(static_cast<std::uint32_t>(nodes_.size()));
    for (std::uint64_t left = members_[word]; left != 0; left &= left - 1)
      nodes_.push_back(static_cast<std::uint32_t>(64 * word) +
                       static_cast<std::uint32_t>(std::countr_zero(left)));
  }
}

bool Subgraph::contains(const Expr& a) const {
  if (a.is_constant() || !(a.graph() == graph_)) return false;
  const std::size_t word = a.node() / 64;
  return word < members_.size() && (members_[word] & bit(a.node())) != 0;
}

std::size_t Subgraph::position(std::uint32_t node) const {
  const std::size_t word = node / 64;
  return before_[word] + static_cast<std::size_t>(std::popcount(members_[word] & (bit(node) - 1)));
}

std::vector<bool> contains_any(const Subgraph& subgraph, const ExprVector& varying) {
  const auto& nodes = subgraph.nodes();
  std::vector<bool> result(nodes.size(), false);
  for (const Expr& variable : varying)
    if (subgraph.contains(variable)) result[subgraph.position(variable)] = true;
  for (std::size_t at = 0; at < nodes.size(); ++at) {
    const Node& node = subgraph.graph().node(nodes[at]);
    const std::uint32_t operand[] = {node.a, node.b, node.c};
    for (int i = 0; i < subgraph.operand_count(nodes[at]); ++i)
      if (result[subgraph.position(operand[i])]) result[at] = true;
  }
  return result;
}

std::vector<Index> contained_groups(const ExprVector& expressions,
                                    const std::vector<ExprVector>& groups) {
  const Subgraph all(expressions);
  std::vector<Index> result;
  for (std::size_t g = 0; g < groups.size(); ++g)
    if (std::any_of(groups[g].begin(), groups[g].end(),
                    [&](const Expr& variable) { return all.contains(variable); }))
      result.push_back(static_cast<Index>(g));
  return result;
}

}  // namespace courant
