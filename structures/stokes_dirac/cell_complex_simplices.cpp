// The maker of CellComplex for simplicial meshes.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "courant/core/numbers/as_size.hpp"
#include "courant/core/words/message.hpp"
#include "courant/structures/stokes_dirac/cell_complex.hpp"

namespace courant {
namespace {

using Simplex = std::vector<Index>;  // numbers of vertices, increasing

std::string vertices_text(const Simplex& simplex) {
  std::string text;
  for (const Index vertex : simplex) text += (text.empty() ? "" : ", ") + std::to_string(vertex);
  return text;
}

// p_i - p_0 as columns.
MatrixXd edges_of(const MatrixXd& vertices, const Simplex& simplex) {
  MatrixXd edges(3, std::ssize(simplex) - 1);
  for (Index i = 0; i < edges.cols(); ++i)
    edges.col(i) = (vertices.row(simplex[as_size(i) + 1]) - vertices.row(simplex[0])).transpose();
  return edges;
}

// The point of the plane of the simplex with the same distance from all vertices.
Eigen::RowVector3d circumcentre(const MatrixXd& vertices, const Simplex& simplex) {
  const MatrixXd E = edges_of(vertices, simplex);
  Eigen::Vector3d from_first = Eigen::Vector3d::Zero();
  if (E.cols() == 1) from_first = E.col(0) / 2.0;
  if (E.cols() >= 2) {
    const Eigen::Vector3d a = E.col(0), b = E.col(1), cross = a.cross(b);
    from_first =
        (a.squaredNorm() * b - b.squaredNorm() * a).cross(cross) / (2.0 * cross.squaredNorm());
    if (E.cols() == 3) {
      const Eigen::Vector3d c = E.col(2);
      from_first =
          (a.squaredNorm() * b.cross(c) + b.squaredNorm() * c.cross(a) + c.squaredNorm() * cross) /
          (2.0 * cross.dot(c));
    }
  }
  return vertices.row(simplex[0]) + from_first.transpose();
}

double volume(const MatrixXd& vertices, const Simplex& simplex) {
  const MatrixXd E = edges_of(vertices, simplex);
  if (E.cols() == 0) return 1.0;
  const Eigen::Vector3d a = E.col(0);
  if (E.cols() == 1) return a.norm();
  const Eigen::Vector3d b = E.col(1), cross = a.cross(b);
  if (E.cols() == 2) return cross.norm() / 2.0;
  const Eigen::Vector3d c = E.col(2);
  return std::abs(cross.dot(c)) / 6.0;
}

Eigen::RowVector3d direction(const MatrixXd& vertices, const Simplex& simplex) {
  const MatrixXd E = edges_of(vertices, simplex);
  if (E.cols() == 1) return E.col(0).transpose() / E.col(0).norm();
  if (E.cols() != 2) return Eigen::RowVector3d::Zero();
  const Eigen::Vector3d a = E.col(0), b = E.col(1), normal = a.cross(b).normalized();
  return normal.transpose();
}

// -1 where the order of the vertices is not that of the axes of space: of edges along x, of triangles seen from +z, of tetrahedra.
double orientation(const MatrixXd& vertices, const Simplex& simplex) {
  const MatrixXd E = edges_of(vertices, simplex);
  if (E.cols() == 1) return E(0, 0) < 0.0 ? -1.0 : 1.0;
  const Eigen::Vector3d a = E.col(0), b = E.col(1), cross = a.cross(b);
  if (E.cols() == 2) return cross[2] < 0.0 ? -1.0 : 1.0;
  const Eigen::Vector3d c = E.col(2);
  return cross.dot(c) < 0.0 ? -1.0 : 1.0;
}

// The vertices that are asked for, increasing and different; throws where they are not.
Simplex sorted(Simplex simplex, std::size_t size, Index vertex_count, const std::string& what) {
  std::sort(simplex.begin(), simplex.end());
  const bool is_right = simplex.size() == size &&
                        std::adjacent_find(simplex.begin(), simplex.end()) == simplex.end() &&
                        !simplex.empty() && simplex.front() >= 0 && simplex.back() < vertex_count;
  if (!is_right)
    throw std::invalid_argument("CellComplex::simplicial: " + what + " has the vertices " +
                                vertices_text(simplex) + "; expected " + std::to_string(size) +
                                " different ones from 0 to " + std::to_string(vertex_count - 1) +
                                ".");
  return simplex;
}

Simplex without(const Simplex& simplex, std::size_t i) {
  Simplex face = simplex;
  face.erase(face.begin() + static_cast<std::ptrdiff_t>(i));
  return face;
}

}  // namespace

CellComplex CellComplex::simplicial(const MatrixXd& vertices,
                                    const std::vector<std::vector<Index>>& simplices,
                                    const std::vector<NamedFacets>& named) {
  if (vertices.cols() != 3 || simplices.empty() || simplices.front().size() < 2 ||
      simplices.front().size() > 4)
    throw std::invalid_argument(
        "CellComplex::simplicial: expected vertices with 3 coordinates and one simplex at least, "
        "of 2 to 4 vertices.");
  const std::size_t n = simplices.front().size() - 1;
  // Simplices of each dimension with their numbers, in the order of their vertices; n-simplices as they come.
  std::vector<std::map<Simplex, Index>> numbers(n + 1);
  std::vector<std::vector<Simplex>> cells(n + 1);
  for (std::size_t i = 0; i < simplices.size(); ++i) {
    const std::string what = "the simplex " + std::to_string(i);
    cells[n].push_back(sorted(simplices[i], n + 1, vertices.rows(), what));
    if (!numbers[n].emplace(cells[n].back(), static_cast<Index>(i)).second)
      throw std::invalid_argument("CellComplex::simplicial: " + what + " is there already.");
    const double size = volume(vertices, cells[n].back()),
                 length = edges_of(vertices, cells[n].back()).colwise().norm().maxCoeff();
    if (!(size > 1e-12 * std::pow(length, static_cast<double>(n))))
      throw std::invalid_argument("CellComplex::simplicial: " + what + " has the size " +
                                  number_text(size) + "; expected more than 0.");
  }
  for (std::size_t k = n; k-- > 0;) {
    for (const Simplex& cell : cells[k + 1])
      for (std::size_t i = 0; i < cell.size(); ++i) numbers[k].emplace(without(cell, i), 0);
    for (auto& [cell, number] : numbers[k]) {
      number = std::ssize(cells[k]);
      cells[k].push_back(cell);
    }
  }
  if (std::ssize(cells[0]) != vertices.rows())
    throw std::invalid_argument(
        "CellComplex::simplicial: " + std::to_string(vertices.rows() - std::ssize(cells[0])) +
        " vertices belong to no simplex; expected none.");
  Data data;
  for (std::size_t k = 0; k <= n; ++k) {
    const Index count = std::ssize(cells[k]);
    data.positions.emplace_back(count, 3);
    data.directions.emplace_back(count, 3);
    data.measures.emplace_back(count);
    for (Index i = 0; i < count; ++i) {
      const Simplex& cell = cells[k][as_size(i)];
      const double sign = k == n ? orientation(vertices, cell) : 1.0;
      data.positions[k].row(i) = circumcentre(vertices, cell);
      data.directions[k].row(i) = sign * direction(vertices, cell);
      data.measures[k][i] = volume(vertices, cell);
    }
  }
  for (std::size_t k = 0; k < n; ++k) {
    std::vector<Eigen::Triplet<double>> d, distances;
    for (std::size_t j = 0; j < cells[k + 1].size(); ++j) {
      const Simplex& cell = cells[k + 1][j];
      const Eigen::RowVector3d centre = data.positions[k + 1].row(static_cast<Index>(j));
      double sign = k + 1 == n ? orientation(vertices, cell) : 1.0;
      for (std::size_t i = 0; i < cell.size(); ++i, sign = -sign) {
        const Index face = numbers[k].at(without(cell, i));
        const Eigen::RowVector3d from = data.positions[k].row(face),
                                 opposite = vertices.row(cell[i]);
        const double side = (centre - from).dot(opposite - from) < 0.0 ? -1.0 : 1.0;
        d.emplace_back(static_cast<int>(j), static_cast<int>(face), sign);
        distances.emplace_back(static_cast<int>(j), static_cast<int>(face),
                               side * (centre - from).norm());
      }
    }
    const Index rows = std::ssize(cells[k + 1]), columns = std::ssize(cells[k]);
    data.coboundaries.emplace_back(rows, columns).setFromTriplets(d.begin(), d.end());
    data.distances.emplace_back(rows, columns).setFromTriplets(distances.begin(), distances.end());
  }
  const SparseMatrixXd& last = data.coboundaries.back();
  for (Index facet = 0; facet < last.cols(); ++facet)
    if (last.col(facet).nonZeros() > 2 && n > 1)
      throw std::invalid_argument("CellComplex::simplicial: the facet with the vertices " +
                                  vertices_text(cells[n - 1][as_size(facet)]) +
                                  " bounds more than two simplices; expected a manifold.");
  std::vector<Region> regions;
  for (const NamedFacets& region : named) {
    regions.push_back({region.name, {}});
    for (const std::vector<Index>& facet : region.facets) {
      const Simplex cell =
          sorted(facet, n, vertices.rows(), "a facet of the region \"" + region.name + "\"");
      const auto found = numbers[n - 1].find(cell);
      if (found == numbers[n - 1].end())
        throw std::invalid_argument("CellComplex::simplicial: the region \"" + region.name +
                                    "\" has a facet with the vertices " + vertices_text(cell) +
                                    ", which bounds no simplex.");
      regions.back().facets.push_back(found->second);
    }
  }
  return CellComplex(std::move(data), std::move(regions));
}

}  // namespace courant
