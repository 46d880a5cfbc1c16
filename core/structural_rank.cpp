#include "courant/core/structural_rank.hpp"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/max_cardinality_matching.hpp>
#include <vector>

namespace courant {

Index structural_rank(const SparseMatrixXd& A) {
  using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS>;
  const auto columns = static_cast<std::size_t>(A.cols());
  Graph graph(columns + static_cast<std::size_t>(A.rows()));
  for (Index j = 0; j < A.outerSize(); ++j)
    for (SparseMatrixXd::InnerIterator it(A, j); it; ++it)
      if (it.value() != 0.0)
        boost::add_edge(static_cast<std::size_t>(j), columns + static_cast<std::size_t>(it.row()),
                        graph);
  std::vector<boost::graph_traits<Graph>::vertex_descriptor> mate(boost::num_vertices(graph));
  boost::edmonds_maximum_cardinality_matching(graph, mate.data());
  return static_cast<Index>(boost::matching_size(graph, mate.data()));
}

}  // namespace courant
