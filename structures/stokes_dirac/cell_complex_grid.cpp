// The makers of CellComplex for grids and graphs.
#include <algorithm>
#include <array>
#include <stdexcept>

#include "courant/core/numbers/as_size.hpp"
#include "courant/core/words/message.hpp"
#include "courant/structures/stokes_dirac/cell_complex.hpp"

namespace courant {
namespace {

using GridTriplets = std::vector<Eigen::Triplet<double>>;

SparseMatrixXd sparse_of_cells(Index rows, Index columns, const GridTriplets& triplets) {
  SparseMatrixXd matrix(rows, columns);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return matrix;
}

void add_entry(GridTriplets& triplets, Index row, Index column, double value) {
  triplets.emplace_back(static_cast<int>(row), static_cast<int>(column), value);
}

// The cells of a grid with edges along some axes and points on the others.
struct Orthotope {
  std::vector<bool> is_long;       // of each axis
  std::vector<Index> counts;       // of each axis
  Index first = 0, dimension = 0;  // the number of its first cell among those of its dimension

  Index size() const {
    Index product = 1;
    for (const Index count : counts) product *= count;
    return product;
  }
  // Where a cell is on each axis, and back.
  std::vector<Index> places(Index cell) const {
    std::vector<Index> place(counts.size());
    for (std::size_t a = 0; a < counts.size(); ++a) {
      place[a] = cell % counts[a];
      cell /= counts[a];
    }
    return place;
  }
  Index number(const std::vector<Index>& place) const {
    Index cell = 0;
    for (std::size_t a = counts.size(); a-- > 0;) cell = cell * counts[a] + place[a];
    return first + cell;
  }
};

// All of them, in order of dimensions and then of their axes; with how many cells there are of each dimension.
std::vector<Orthotope> orthotopes(const std::vector<VectorXd>& axes, std::vector<Index>& counts) {
  const std::size_t n = axes.size();
  std::vector<Orthotope> all;
  counts.assign(n + 1, 0);
  for (std::size_t k = 0; k <= n; ++k) {
    std::vector<bool> is_long(n, false);
    std::fill_n(is_long.begin(), k, true);
    do {
      Orthotope one{is_long, {}, counts[k], static_cast<Index>(k)};
      for (std::size_t a = 0; a < n; ++a)
        one.counts.push_back(axes[a].size() - (is_long[a] ? 1 : 0));
      counts[k] += one.size();
      all.push_back(std::move(one));
    } while (std::prev_permutation(is_long.begin(), is_long.end()));
  }
  return all;
}

Eigen::RowVector3d direction_of(const Orthotope& cells) {
  Eigen::RowVector3d direction = Eigen::RowVector3d::Zero();
  if (cells.dimension == 1)
    for (std::size_t a = 0; a < cells.is_long.size(); ++a)
      if (cells.is_long[a]) direction[static_cast<Index>(a)] = 1.0;
  if (cells.dimension == 2) {
    // The normal of (e_a, e_b), a < b.
    const bool x = cells.is_long[0], y = cells.is_long[1];
    if (x && y)
      direction[2] = 1.0;
    else if (x)
      direction[1] = -1.0;
    else
      direction[0] = 1.0;
  }
  return direction;
}

VectorXd equal_cells(double length, Index cells) {
  if (!(length > 0.0) || cells < 1)
    throw std::invalid_argument("CellComplex: " + std::to_string(cells) +
                                " cells over a length of " + number_text(length) +
                                "; expected one at least, and a length above 0.");
  VectorXd lines = VectorXd::LinSpaced(cells + 1, 0.0, length);
  return lines;
}

}  // namespace

CellComplex CellComplex::grid(const std::vector<VectorXd>& axes) {
  if (axes.empty() || axes.size() > 3)
    throw std::invalid_argument("CellComplex::grid: there are " + std::to_string(axes.size()) +
                                " axes; expected 1 to 3.");
  for (const VectorXd& lines : axes) {
    bool increases = lines.size() >= 2 && lines.allFinite();
    for (Index i = 1; increases && i < lines.size(); ++i) increases = lines[i] > lines[i - 1];
    if (!increases)
      throw std::invalid_argument(
          "CellComplex::grid: the lines of an axis do not increase; expected two at least, each "
          "greater than the one before.");
  }
  std::vector<Index> counts;
  const std::vector<Orthotope> all = orthotopes(axes, counts);
  const std::size_t n = axes.size();
  Data data;
  for (const Index count : counts) {
    data.positions.emplace_back(MatrixXd::Zero(count, 3));
    data.directions.emplace_back(MatrixXd::Zero(count, 3));
    data.measures.emplace_back(VectorXd::Ones(count));
  }
  std::vector<GridTriplets> d(n), distances(n);
  std::vector<Region> regions;
  const std::array<std::array<const char*, 2>, 3> sides{
      {{"left", "right"}, {"bottom", "top"}, {"back", "front"}}};
  for (std::size_t a = 0; a < n; ++a)
    for (const char* side : sides[a]) regions.push_back({side, {}});
  for (const Orthotope& cells : all) {
    const auto k = as_size(cells.dimension);
    // The cells that are short on one of its axes more: its faces across that axis.
    std::vector<const Orthotope*> across(n, nullptr);
    for (std::size_t a = 0; a < n; ++a) {
      if (!cells.is_long[a]) continue;
      std::vector<bool> of_face = cells.is_long;
      of_face[a] = false;
      across[a] = &*std::ranges::find(all, of_face, &Orthotope::is_long);
    }
    const Eigen::RowVector3d direction = direction_of(cells);
    for (Index cell = 0; cell < cells.size(); ++cell) {
      const std::vector<Index> place = cells.places(cell);
      const Index number = cells.first + cell;
      data.directions[k].row(number) = direction;
      for (std::size_t a = 0; a < n; ++a) {
        const double low = axes[a][place[a]];
        const double high = cells.is_long[a] ? axes[a][place[a] + 1] : low;
        data.positions[k](number, static_cast<Index>(a)) = (low + high) / 2.0;
        if (cells.is_long[a]) data.measures[k][number] *= high - low;
        if (k + 1 == n && !cells.is_long[a]) {
          if (place[a] == 0) regions[2 * a].facets.push_back(number);
          if (place[a] == axes[a].size() - 1) regions[2 * a + 1].facets.push_back(number);
        }
      }
      // Its faces: on each of its axes the low end and the high one.
      double sign = 1.0;
      for (std::size_t a = 0; a < n; ++a) {
        if (!cells.is_long[a]) continue;
        const double half = (axes[a][place[a] + 1] - axes[a][place[a]]) / 2.0;
        for (const Index end : {0, 1}) {
          std::vector<Index> where = place;
          where[a] += end;
          const Index face = across[a]->number(where);
          add_entry(d[k - 1], number, face, end == 1 ? sign : -sign);
          add_entry(distances[k - 1], number, face, half);
        }
        sign = -sign;
      }
    }
  }
  for (std::size_t k = 0; k < n; ++k) {
    data.coboundaries.push_back(sparse_of_cells(counts[k + 1], counts[k], d[k]));
    data.distances.push_back(sparse_of_cells(counts[k + 1], counts[k], distances[k]));
  }
  return CellComplex(std::move(data), std::move(regions));
}

CellComplex CellComplex::interval(double length, Index cells) {
  return grid({equal_cells(length, cells)});
}

CellComplex CellComplex::rectangle(double width, double height, Index columns, Index rows) {
  return grid({equal_cells(width, columns), equal_cells(height, rows)});
}

CellComplex CellComplex::box(const std::array<double, 3>& lengths,
                             const std::array<Index, 3>& cells) {
  return grid({equal_cells(lengths[0], cells[0]), equal_cells(lengths[1], cells[1]),
               equal_cells(lengths[2], cells[2])});
}

CellComplex CellComplex::graph(Index vertex_count,
                               const std::vector<std::pair<Index, Index>>& edges,
                               const VectorXd& lengths) {
  const Index count = std::ssize(edges);
  if (lengths.size() != count || count == 0 || !(lengths.minCoeff() > 0.0))
    throw std::invalid_argument("CellComplex::graph: there are " + std::to_string(lengths.size()) +
                                " lengths for " + std::to_string(count) +
                                " edges; expected one above 0 for each, and one edge at least.");
  GridTriplets d, distances;
  std::vector<Index> degrees(as_size(vertex_count), 0);
  for (Index edge = 0; edge < count; ++edge) {
    const auto [from, to] = edges[as_size(edge)];
    if (from == to || std::min(from, to) < 0 || std::max(from, to) >= vertex_count)
      throw std::invalid_argument("CellComplex::graph: the edge " + std::to_string(edge) +
                                  " leads from " + std::to_string(from) + " to " +
                                  std::to_string(to) + "; expected two vertices from 0 to " +
                                  std::to_string(vertex_count - 1) + ".");
    add_entry(d, edge, from, -1.0);
    add_entry(d, edge, to, 1.0);
    for (const Index end : {from, to}) {
      add_entry(distances, edge, end, lengths[edge] / 2.0);
      ++degrees[as_size(end)];
    }
  }
  Data data{{MatrixXd::Zero(vertex_count, 3), MatrixXd::Zero(count, 3)},
            {MatrixXd::Zero(vertex_count, 3), MatrixXd::Zero(count, 3)},
            {VectorXd::Ones(vertex_count), lengths},
            {sparse_of_cells(count, vertex_count, d)},
            {sparse_of_cells(count, vertex_count, distances)}};
  std::vector<Region> regions;
  for (Index vertex = 0; vertex < vertex_count; ++vertex)
    if (degrees[as_size(vertex)] == 1)
      regions.push_back({"end" + std::to_string(vertex), {vertex}});
  return CellComplex(std::move(data), std::move(regions));
}

}  // namespace courant
