// CellComplex: oriented cells of dimensions 0 to 3, what bounds what, and their sizes.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <string>
#include <utility>
#include <vector>

namespace courant {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using SparseMatrixXd = Eigen::SparseMatrix<double>;

// A complex K of dimension n, 1 ≤ n ≤ 3, with N_k oriented cells of dimension k, in R³ or without a place, and its
// circumcentric dual ⋆K, whose cell ⋆σ of dimension n - k belongs to the cell σ of dimension k.
//
// A k-cochain has a number for each k-cell, the integral of a k-form over it. d_k: C^k → C^{k+1}, the coboundary, has
// the entries ±1 (Stokes' theorem on a cell), and the coboundary of the dual complex is its transpose up to sign.
//
//   X1  d_{k+1} d_k = 0
//   X2  each (n-1)-cell bounds one n-cell, where it is on the boundary, or two (of a graph any number)
//   X3  Σ |σ||⋆σ| over the k-cells is (n choose k) times the volume
//
// The dual cell is cut off at the boundary. A centre is the middle of a box and the circumcentre of a simplex, so that
// σ and ⋆σ are orthogonal and the Hodge star is the diagonal matrix |⋆σ|/|σ|, of order 2 on grids. It needs |⋆σ| > 0,
// which holds for well-centred meshes, and for Delaunay ones that are not degenerate: the makers refuse others.
//
// Orientation: an edge of a grid points along its axis, an edge of a graph from its first to its second vertex; cells
// of simplicial meshes are oriented by the order of their vertices' numbers, n-cells by the axes of space. Immutable.
// Reference: Hirani, Discrete exterior calculus (2003); Seslija, Scherpen, van der Schaft, Explicit simplicial
// discretization of distributed-parameter port-Hamiltonian systems, Automatica 50 (2014).
class CellComplex {
 public:
  // A part of the boundary by name: some of its (n-1)-cells.
  struct Region {
    std::string name;
    std::vector<Index> facets;
  };

  // Intervals, rectangles and boxes: the lines of a grid on each of one to three axes, increasing. x runs fastest in
  // the numbers of cells; edges along x come before those along y, faces xy before xz before yz. Regions: left and
  // right (x), bottom and top (y), back and front (z). Throws std::invalid_argument if there are no cells.
  static CellComplex grid(const std::vector<VectorXd>& axes);
  // Equal cells from 0 on.
  static CellComplex interval(double length, Index cells);
  static CellComplex rectangle(double width, double height, Index columns, Index rows);
  static CellComplex box(const std::array<double, 3>& lengths, const std::array<Index, 3>& cells);

  // A region of a mesh: each facet by the numbers of its n vertices.
  struct NamedFacets {
    std::string name;
    std::vector<std::vector<Index>> facets;
  };
  // Simplices of n + 1 vertices each, by the numbers of the rows of `vertices` (N_0 × 3). Throws
  // std::invalid_argument for vertices that are missing, degenerate or repeated simplices, a facet of more than two
  // simplices, a region with a facet that is not on the boundary, and where a dual cell has no positive size.
  static CellComplex simplicial(const MatrixXd& vertices,
                                const std::vector<std::vector<Index>>& simplices,
                                const std::vector<NamedFacets>& regions = {});
  // Edges of given lengths between vertices; the ends, vertices of one edge, are the boundary, each a region of the
  // name "end<vertex>". Cells have no place: positions are 0.
  static CellComplex graph(Index vertex_count, const std::vector<std::pair<Index, Index>>& edges,
                           const VectorXd& lengths);

  Index dimension() const { return static_cast<Index>(positions_.size()) - 1; }     // n
  Index count(Index k) const { return at(positions_, k).rows(); }                   // N_k
  const SparseMatrixXd& coboundary(Index k) const { return at(coboundaries_, k); }  // N_{k+1} × N_k

  // The centres of k-cells (N_k × 3); unit tangents of edges, unit normals of faces (N_k × 3), 0 of others.
  const MatrixXd& positions(Index k) const { return at(positions_, k); }
  const MatrixXd& directions(Index k) const { return at(directions_, k); }
  // |σ| and |⋆σ|, in m^k and m^(n-k); 1 of points.
  const VectorXd& measures(Index k) const { return at(measures_, k); }
  const VectorXd& dual_measures(Index k) const { return at(dual_measures_, k); }

  // The (n-1)-cells that bound one n-cell, increasing, and the named parts of them.
  const std::vector<Index>& boundary() const { return boundary_; }
  const std::vector<Region>& regions() const { return regions_; }
  // Null if there is none of the name.
  const Region* region(const std::string& name) const;
  // The same complex with one more region. Throws std::invalid_argument if the name is taken or a facet is not on the
  // boundary.
  CellComplex with_region(Region region) const;

  // The k-cells in some facets, increasing, k < n.
  std::vector<Index> cells_of(Index k, const std::vector<Index>& facets) const;
  // |⋆_b σ| in m^(n-1-k): the size of the dual of a k-cell within the facets, 0 of cells that are not there (N_k).
  VectorXd boundary_dual_measures(Index k, const std::vector<Index>& facets) const;

 private:
  // What makers give: positions, directions, measures of each dimension, coboundaries, and for each entry of these
  // the distance from the centre of the k-cell to that of the (k+1)-cell, negative on the side where that is not.
  struct Data {
    std::vector<MatrixXd> positions, directions;
    std::vector<VectorXd> measures;
    std::vector<SparseMatrixXd> coboundaries, distances;
  };
  CellComplex(Data data, std::vector<Region> regions);
  template <class T>
  static const T& at(const std::vector<T>& list, Index k) {
    return list.at(static_cast<std::size_t>(k));
  }
  // Σ over flags σ ⊂ … of the distances, divided by (m-k)!: sizes of duals in the cells of dimension m, by weights.
  VectorXd duals(Index k, Index m, VectorXd weights) const;
  void require_boundary(const Region& region) const;

  std::vector<MatrixXd> positions_, directions_;
  std::vector<VectorXd> measures_, dual_measures_;
  std::vector<SparseMatrixXd> coboundaries_, distances_;
  std::vector<Index> boundary_;
  std::vector<Region> regions_;
};

}  // namespace courant
