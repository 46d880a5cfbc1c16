#include "courant/core/linear/two_ended_ordering.hpp"

#include <camd.h>

#include <algorithm>
#include <optional>

namespace courant {
namespace {

// Levels of nodes equally far from one end: long and thin is what has at least a level for so many nodes, and so few
// nodes in the one where it is cut.
constexpr int kNodesForALevel = 8;
constexpr int kMostCut = 8;

// Smaller matrices are solved with before anything has to wait.
constexpr int kLeastSize = 32;

// Of A + Aᵀ, without its diagonal: the neighbours of node i are those from begin[i] on.
struct Neighbours {
  std::vector<int> begin, node;

  Neighbours(std::span<const int> offsets, std::span<const int> rows)
      : begin(offsets.size(), 0), node(2 * rows.size()) {
    const int n = static_cast<int>(offsets.size()) - 1;
    const auto for_each_pair = [&](auto f) {
      for (int j = 0; j < n; ++j)
        for (int k = offsets[at(j)]; k < offsets[at(j) + 1]; ++k)
          if (const int i = rows[at(k)]; i != j) f(i, j), f(j, i);
    };
    for_each_pair([&](int i, int) { ++begin[at(i)]; });
    for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
    for_each_pair([&](int i, int j) { node[at(--begin[at(i)])] = j; });
  }
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  std::span<const int> of(int i) const {
    return std::span(node).subspan(at(begin[at(i)]), at(begin[at(i) + 1] - begin[at(i)]));
  }
};

// Nodes by their distance from one of them.
struct Levels {
  std::vector<int> node, begin;  // level k: from begin[k] on

  Levels(const Neighbours& neighbours, int from) : node{from}, begin{0} {
    std::vector<bool> is_found(neighbours.begin.size() - 1, false);
    is_found[Neighbours::at(from)] = true;
    while (begin.back() < std::ssize(node)) {
      const auto first = Neighbours::at(begin.back()), last = node.size();
      begin.push_back(static_cast<int>(last));
      for (std::size_t k = first; k < last; ++k)
        for (const int next : neighbours.of(node[k]))
          if (!is_found[Neighbours::at(next)]) {
            is_found[Neighbours::at(next)] = true;
            node.push_back(next);
          }
    }
    begin.pop_back();
  }
  int count() const { return static_cast<int>(begin.size()); }
  int size(int level) const {
    const int end =
        level + 1 < count() ? begin[Neighbours::at(level) + 1] : static_cast<int>(std::ssize(node));
    return end - begin[Neighbours::at(level)];
  }
};

// The first half of nodes, what cuts it off, the rest: 0, 2 and 1 for each node. None where the graph is not long and thin.
std::optional<std::vector<int>> parts(const Neighbours& neighbours) {
  const auto n = static_cast<int>(neighbours.begin.size()) - 1;
  const Levels levels(neighbours, Levels(neighbours, 0).node.back());  // from an end
  if (std::ssize(levels.node) < n || levels.count() * kNodesForALevel < n) return std::nullopt;
  int cut = 0;
  while (cut + 1 < levels.count() && levels.begin[Neighbours::at(cut) + 1] < n / 2) ++cut;
  if (levels.size(cut) > kMostCut) return std::nullopt;
  std::vector<int> part(Neighbours::at(n), 1);
  const int first = levels.begin[Neighbours::at(cut)];
  for (int k = 0; k < first + levels.size(cut); ++k)
    part[Neighbours::at(levels.node[Neighbours::at(k)])] = k < first ? 0 : 2;
  return part;
}

}  // namespace

std::vector<int> two_ended_ordering(std::span<const int> offsets, std::span<const int> rows) {
  const auto n = static_cast<int>(offsets.size()) - 1;
  if (n < kLeastSize) return {};
  const auto part = parts(Neighbours(offsets, rows));
  if (!part) return {};
  std::vector<int> is_last(part->size()), order(part->size());
  std::ranges::transform(*part, is_last.begin(), [](int p) { return p == 2 ? 1 : 0; });
  if (camd_order(n, offsets.data(), rows.data(), order.data(), nullptr, nullptr, is_last.data()) <
      CAMD_OK)
    return {};
  std::vector<int> halves[2], result;
  for (const int i : order)
    if (const int p = (*part)[Neighbours::at(i)]; p < 2) halves[p].push_back(i);
  for (std::size_t k = 0; k < std::max(halves[0].size(), halves[1].size()); ++k)
    for (const std::vector<int>& half : halves)
      if (k < half.size()) result.push_back(half[k]);
  for (const int i : order)
    if ((*part)[Neighbours::at(i)] == 2) result.push_back(i);
  return result;
}

}  // namespace courant
