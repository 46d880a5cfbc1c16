#include "courant/extensions/petsc/block_graph.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <stdexcept>

namespace courant {
namespace {

constexpr std::size_t kManyUnknowns = 200;
// A body has no more; where all equations contain all unknowns, these are divided all the same.
constexpr Index kLargestBlock = 12;

void keep_each_once(std::vector<Index>& numbers) {
  std::ranges::sort(numbers);
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

// Of each row the column that it is matched with: in their order where that can be, since equations of a step follow
// the order of what they determine.
std::vector<Index> matching_of(Index size, const std::vector<PatternEntry>& entries) {
  const auto on_diagonal = std::ranges::count_if(
      entries, [](const PatternEntry& entry) { return entry.row == entry.column; });
  if (on_diagonal != size) return largest_matching(size, size, entries);
  std::vector<Index> result(static_cast<std::size_t>(size));
  std::iota(result.begin(), result.end(), Index{0});
  return result;
}

}  // namespace

BlockGraph::BlockGraph(const std::string& name, Index equations,
                       const std::vector<PatternEntry>& pattern) {
  for (const PatternEntry& entry : pattern) contained.push_back(entry.column);
  keep_each_once(contained);
  const auto place = [&](Index unknown) {
    return std::ranges::lower_bound(contained, unknown) - contained.begin();
  };
  const Index size = std::ssize(contained);
  if (equations != size)
    throw std::invalid_argument(
        "BlockGraph: a step of " + name + " has " + std::to_string(equations) + " equations for " +
        std::to_string(size) + " unknowns; the engine solves as many equations as unknowns.");
  std::vector<PatternEntry> entries;
  for (const PatternEntry& entry : pattern) entries.push_back({entry.row, place(entry.column)});
  const std::vector<Index> matched = matching_of(size, entries);
  equation.assign(static_cast<std::size_t>(size), -1);
  for (Index row = 0; row < equations; ++row)
    if (const Index column = matched[static_cast<std::size_t>(row)]; column >= 0)
      equation[static_cast<std::size_t>(column)] = row;
  if (std::ranges::find(equation, -1) != equation.end())
    throw std::invalid_argument("BlockGraph: the equations of a step of " + name +
                                " do not determine their unknowns, whatever the numbers; the "
                                "engine solves equations that do.");

  // Unknowns that the same equations contain, one after the other in a block.
  std::vector<std::vector<Index>> rows(static_cast<std::size_t>(equations)),
      columns(contained.size());
  for (const PatternEntry& entry : entries)
    rows[static_cast<std::size_t>(entry.row)].push_back(entry.column);
  for (std::size_t row = 0; row < rows.size(); ++row)
    if (rows[row].size() <= kManyUnknowns)
      for (const Index column : rows[row])
        columns[static_cast<std::size_t>(column)].push_back(static_cast<Index>(row));
  std::map<std::vector<Index>, Index> blocks;
  for (const auto& column : columns) {
    Index& number = blocks.emplace(column, std::ssize(weights)).first->second;
    if (number < std::ssize(weights) && weights[static_cast<std::size_t>(number)] == kLargestBlock)
      number = std::ssize(weights);
    if (number == std::ssize(weights)) weights.push_back(0);
    block.push_back(number);
    ++weights[static_cast<std::size_t>(number)];
  }
  std::vector<std::vector<Index>> around(weights.size());
  const auto add = [&](Index one, Index other) {
    if (one != other) around[static_cast<std::size_t>(one)].push_back(other);
  };
  for (std::size_t j = 0; j < block.size(); ++j) {
    const auto& row = rows[static_cast<std::size_t>(equation[j])];
    if (row.size() > kManyUnknowns) continue;
    for (const Index k : row) {
      const Index other = block[static_cast<std::size_t>(k)];
      add(block[j], other);
      add(other, block[j]);
    }
  }
  begins.push_back(0);
  for (auto& of_one : around) {
    keep_each_once(of_one);
    neighbours.insert(neighbours.end(), of_one.begin(), of_one.end());
    begins.push_back(std::ssize(neighbours));
  }
}

}  // namespace courant
