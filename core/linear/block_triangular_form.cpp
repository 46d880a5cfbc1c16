#include "courant/core/linear/block_triangular_form.hpp"

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/strong_components.hpp>

namespace courant {

std::optional<std::vector<DiagonalBlock>> block_triangular_form(
    Eigen::Index size, std::span<const PatternEntry> entries) {
  const auto count = static_cast<std::size_t>(size);
  const std::vector<Eigen::Index> column_of = largest_matching(size, size, entries);
  if (std::ranges::count(column_of, Eigen::Index{-1}) > 0) return std::nullopt;
  std::vector<std::size_t> row_of(count);
  for (std::size_t row = 0; row < count; ++row)
    row_of[static_cast<std::size_t>(column_of[row])] = row;
  // An edge leads from a row to those that have to be solved before. Strong components are numbered from those that no
  // edge leaves.
  using Directed = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS>;
  Directed graph(count);
  for (const auto& [row, column] : entries)
    boost::add_edge(static_cast<std::size_t>(row), row_of[static_cast<std::size_t>(column)], graph);
  std::vector<std::size_t> component(count);
  const std::size_t components =
      count == 0 ? 0 : static_cast<std::size_t>(boost::strong_components(graph, component.data()));
  std::vector<DiagonalBlock> blocks(components);
  for (std::size_t row = 0; row < count; ++row) {
    blocks[component[row]].rows.push_back(static_cast<Eigen::Index>(row));
    blocks[component[row]].columns.push_back(column_of[row]);
  }
  for (DiagonalBlock& block : blocks) std::ranges::sort(block.columns);
  return blocks;
}

}  // namespace courant
