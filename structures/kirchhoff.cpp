#include "courant/structures/kirchhoff.hpp"

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/breadth_first_search.hpp>
#include <boost/graph/filtered_graph.hpp>
#include <boost/graph/kruskal_min_spanning_tree.hpp>
#include <cstdint>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

#include "courant/core/numbers/as_size.hpp"

namespace courant {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

SparseMatrixXd sparse(Index rows, Index columns, const Triplets& triplets) {
  SparseMatrixXd matrix(rows, columns);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return matrix;
}

void add(Triplets& triplets, Index row, Index column, double value) {
  triplets.emplace_back(static_cast<int>(row), static_cast<int>(column), value);
}

// Loops of a chain of n elements have n²/2 elements in all, which take all memory before n is 10⁵. So many take 2 GB
// with the copies that products of them make.
void require_few(Index elements, const std::string& function, const std::string& what) {
  constexpr Index most = 60'000'000;
  if (elements > most)
    throw std::length_error("Kirchhoff::" + function + ": the " + what + " have more than " +
                            std::to_string(most) +
                            " elements in all; expected a smaller network, or one with shorter "
                            "ways from node to node.");
}

// A bijection that scatters consecutive numbers (the finaliser of SplitMix64).
std::uint64_t scattered(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31U);
}

// An element where only connections matter, with what the spanning forest chooses by.
struct Connection {
  Index element = 0;
  std::pair<double, std::uint64_t> weight;
};

using Skeleton = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS,
                                       boost::no_property, Connection>;
using SkeletonEdge = boost::graph_traits<Skeleton>::edge_descriptor;

struct InForest {
  const Skeleton* skeleton = nullptr;
  const std::vector<bool>* in_forest = nullptr;

  bool operator()(const SkeletonEdge& edge) const {
    return (*in_forest)[as_size((*skeleton)[edge].element)];
  }
};

// Notes for each node of a tree the way back to the root.
struct RecordWayBack : boost::default_bfs_visitor {
  std::vector<Index>& parent;
  std::vector<Index>& parent_element;
  std::vector<Index>& depth;

  RecordWayBack(std::vector<Index>& of_parent, std::vector<Index>& of_element,
                std::vector<Index>& of_depth)
      : parent(of_parent), parent_element(of_element), depth(of_depth) {}

  template <class Edge, class Graph>
  void tree_edge(const Edge& edge, const Graph& graph) const {
    const auto from = boost::source(edge, graph), to = boost::target(edge, graph);
    parent[to] = static_cast<Index>(from);
    parent_element[to] = graph[edge].element;
    depth[to] = depth[from] + 1;
  }
};

// The matrix whose columns are these unit vectors of R^n.
SparseMatrixXd selection(const std::vector<Index>& indices, Index n) {
  SparseMatrixXd result(n, static_cast<Index>(indices.size()));
  for (Index k = 0; k < result.cols(); ++k) {
    result.startVec(k);
    result.insertBack(indices[as_size(k)], k) = 1.0;
  }
  result.finalize();
  return result;
}

// A larger matrix of zeros with `block` at (row, column).
SparseMatrixXd embedded(const SparseMatrixXd& block, Index row, Index column, Index rows,
                        Index columns) {
  SparseMatrixXd result(rows, columns);
  result.reserve(block.nonZeros());
  for (Index j = 0; j < columns; ++j) {
    result.startVec(j);
    if (j < column || j >= column + block.cols()) continue;
    for (SparseMatrixXd::InnerIterator it(block, j - column); it; ++it) {
      result.insertBack(row + it.row(), j) = it.value();
    }
  }
  result.finalize();
  return result;
}

}  // namespace

Kirchhoff::Kirchhoff(const CircuitGraph& graph)
    : node_count_(static_cast<Index>(graph.node_count)) {
  Skeleton skeleton(graph.node_count);
  for (const auto& [source, target, properties] : graph.edges) {
    const Index element = element_count();
    source_.push_back(static_cast<Index>(source));
    target_.push_back(static_cast<Index>(target));
    add_edge(
        source, target,
        Connection{element, {properties.weight, scattered(static_cast<std::uint64_t>(element))}},
        skeleton);
  }

  std::vector<bool> in_forest(source_.size(), false);
  std::vector<SkeletonEdge> forest;
  boost::kruskal_minimum_spanning_tree(skeleton, std::back_inserter(forest),
                                       boost::weight_map(get(&Connection::weight, skeleton)));
  for (const SkeletonEdge& edge : forest) in_forest[as_size(skeleton[edge].element)] = true;
  for (Index element = 0; element < element_count(); ++element) {
    (in_forest[as_size(element)] ? tree_ : links_).push_back(element);
  }

  parent_.resize(as_size(node_count_));
  parent_element_.resize(as_size(node_count_), -1);
  depth_.resize(as_size(node_count_), 0);
  const boost::filtered_graph<Skeleton, InForest> trees(skeleton, InForest{&skeleton, &in_forest});
  std::vector<boost::default_color_type> color(as_size(node_count_), boost::white_color);
  for (Index node = 0; node < node_count_; ++node) {
    if (color[as_size(node)] != boost::white_color) continue;
    roots_.push_back(node);
    parent_[as_size(node)] = node;
    boost::queue<std::size_t> queue;
    boost::breadth_first_visit(
        trees, as_size(node), queue, RecordWayBack(parent_, parent_element_, depth_),
        boost::make_iterator_property_map(color.begin(), get(boost::vertex_index, trees)));
  }
}

SparseMatrixXd Kirchhoff::incidence() const {
  Triplets triplets;
  triplets.reserve(2 * source_.size());
  for (Index element = 0; element < element_count(); ++element) {
    if (source_[as_size(element)] == target_[as_size(element)])
      continue;  // what enters a node also leaves it
    add(triplets, source_[as_size(element)], element, 1.0);
    add(triplets, target_[as_size(element)], element, -1.0);
  }
  return sparse(node_count_, element_count(), triplets);
}

SparseMatrixXd Kirchhoff::reduced_incidence() const {
  std::vector<Index> kept;
  for (Index node = 0; node < node_count_; ++node) {
    if (parent_[as_size(node)] != node) kept.push_back(node);
  }
  return selection(kept, node_count_).transpose() * incidence();
}

// The link from a to b, then from b through the forest to the nearest common ancestor and on to a.
// Against its orientation an element counts -1.
SparseMatrixXd Kirchhoff::loops() const {
  SparseMatrixXd result(element_count(), static_cast<Index>(links_.size()));
  std::vector<std::pair<Index, double>> loop;
  Index entries = 0;
  for (Index column = 0; column < result.cols(); ++column) {
    const Index link = links_[as_size(column)];
    loop.assign(1, {link, 1.0});
    Index a = source_[as_size(link)], b = target_[as_size(link)];
    while (a != b) {
      if (depth_[as_size(b)] >= depth_[as_size(a)]) {  // up from b
        const Index element = parent_element_[as_size(b)];
        loop.emplace_back(element, source_[as_size(element)] == b ? 1.0 : -1.0);
        b = parent_[as_size(b)];
      } else {  // down to a
        const Index element = parent_element_[as_size(a)];
        loop.emplace_back(element, target_[as_size(element)] == a ? 1.0 : -1.0);
        a = parent_[as_size(a)];
      }
    }
    require_few(entries += static_cast<Index>(loop.size()), "loops", "loops");
    std::ranges::sort(loop);
    result.startVec(column);
    for (const auto& [element, sign] : loop) result.insertBack(element, column) = sign;
  }
  result.finalize();
  return result;
}

// The current of an element of the forest is the sum of the link currents whose loops pass through
// it.
SparseMatrixXd Kirchhoff::cut_sets() const {
  const SparseMatrixXd of_tree = selection(tree_, element_count());
  const SparseMatrixXd through = loops().transpose() * of_tree;
  return of_tree - SparseMatrixXd(selection(links_, element_count()) * through);
}

SparseMatrixXd Kirchhoff::potentials() const {
  Triplets triplets;
  for (Index node = 0; node < node_count_; ++node) {
    require_few(static_cast<Index>(triplets.size()), "potentials", "ways to the nodes");
    for (Index at_node = node; parent_[as_size(at_node)] != at_node;
         at_node = parent_[as_size(at_node)]) {
      const Index element = parent_element_[as_size(at_node)];
      add(triplets, node, element, source_[as_size(element)] == at_node ? 1.0 : -1.0);
    }
  }
  return sparse(node_count_, element_count(), triplets);
}

KernelRepresentation<SparseMatrixXd> Kirchhoff::kernel_representation() const {
  const Index n = element_count(), nodes = node_count_ - component_count();
  return {embedded(reduced_incidence(), 0, 0, n, n), embedded(loops().transpose(), nodes, 0, n, n)};
}

ImageRepresentation<SparseMatrixXd> Kirchhoff::image_representation() const {
  const auto [F, E] = kernel_representation();
  return {E.transpose(), F.transpose()};
}

ConstrainedRepresentation<SparseMatrixXd> Kirchhoff::constrained_representation() const {
  return {SparseMatrixXd(element_count(), element_count()), loops()};
}

HybridRepresentation<SparseMatrixXd> Kirchhoff::hybrid_representation() const {
  const Index n = element_count(), nodes = node_count_ - component_count();
  const SparseMatrixXd currents =
      selection(tree_, n).transpose() * loops();  // of the tree, from those of the links
  const SparseMatrixXd voltages = -currents.transpose();
  return {tree_, links_, embedded(currents, 0, nodes, n, n) + embedded(voltages, nodes, 0, n, n)};
}

LinearDirac Kirchhoff::to_linear_dirac() const {
  const auto [F, E] = kernel_representation();
  return LinearDirac(KernelRepresentation<MatrixXd>{F, E});
}

}  // namespace courant
