#include "courant/core/linear/matching.hpp"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/max_cardinality_matching.hpp>

namespace courant {

std::vector<Eigen::Index> largest_matching(Eigen::Index rows, Eigen::Index columns,
                                           std::span<const PatternEntry> entries) {
  using Bipartite = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS>;
  const auto first_row = static_cast<std::size_t>(columns);
  Bipartite graph(first_row + static_cast<std::size_t>(rows));
  for (const auto& [row, column] : entries)
    boost::add_edge(static_cast<std::size_t>(column), first_row + static_cast<std::size_t>(row),
                    graph);
  std::vector<boost::graph_traits<Bipartite>::vertex_descriptor> mate(boost::num_vertices(graph));
  boost::edmonds_maximum_cardinality_matching(graph, mate.data());
  const auto none = boost::graph_traits<Bipartite>::null_vertex();
  std::vector<Eigen::Index> column_of;
  for (std::size_t row = first_row; row < mate.size(); ++row)
    column_of.push_back(mate[row] == none ? -1 : static_cast<Eigen::Index>(mate[row]));
  return column_of;
}

}  // namespace courant
