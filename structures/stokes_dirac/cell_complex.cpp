#include "courant/structures/stokes_dirac/cell_complex.hpp"

#include <algorithm>
#include <stdexcept>

#include "courant/core/numbers/as_size.hpp"
#include "courant/core/words/message.hpp"

namespace courant {

CellComplex::CellComplex(Data data, std::vector<Region> regions)
    : positions_(std::move(data.positions)),
      directions_(std::move(data.directions)),
      measures_(std::move(data.measures)),
      coboundaries_(std::move(data.coboundaries)),
      distances_(std::move(data.distances)),
      regions_(std::move(regions)) {
  const Index n = dimension();
  for (Index k = 0; k <= n; ++k) {
    dual_measures_.push_back(duals(k, n, VectorXd::Ones(count(n))));
    for (Index cell = 0; cell < count(k); ++cell)
      if (!(dual_measures(k)[cell] > 1e-12 * dual_measures(k).maxCoeff()))
        throw std::invalid_argument(
            "CellComplex: the dual of the cell " + std::to_string(cell) + " of dimension " +
            std::to_string(k) + ", at (" + number_text(positions(k)(cell, 0)) + ", " +
            number_text(positions(k)(cell, 1)) + ", " + number_text(positions(k)(cell, 2)) +
            "), has the size " + number_text(dual_measures(k)[cell]) +
            "; expected more than 0, as in a mesh whose simplices contain their circumcentres.");
  }
  const SparseMatrixXd& last = coboundary(n - 1);
  for (Index facet = 0; facet < count(n - 1); ++facet)
    if (last.col(facet).nonZeros() == 1) boundary_.push_back(facet);
  for (Region& region : regions_) {
    std::sort(region.facets.begin(), region.facets.end());
    require_boundary(region);
  }
}

void CellComplex::require_boundary(const Region& region) const {
  for (const Index facet : region.facets)
    if (!std::binary_search(boundary_.begin(), boundary_.end(), facet))
      throw std::invalid_argument("CellComplex: the region \"" + region.name + "\" has the cell " +
                                  std::to_string(facet) + " of dimension " +
                                  std::to_string(dimension() - 1) +
                                  ", which is not on the boundary; expected cells that bound one "
                                  "other.");
}

const CellComplex::Region* CellComplex::region(const std::string& name) const {
  const auto found = std::find_if(regions_.begin(), regions_.end(),
                                  [&](const Region& one) { return one.name == name; });
  return found == regions_.end() ? nullptr : &*found;
}

CellComplex CellComplex::with_region(Region region) const {
  if (this->region(region.name))
    throw std::invalid_argument("CellComplex::with_region: there is a region \"" + region.name +
                                "\" already; expected another name.");
  std::sort(region.facets.begin(), region.facets.end());
  require_boundary(region);
  CellComplex result = *this;
  result.regions_.push_back(std::move(region));
  return result;
}

std::vector<Index> CellComplex::cells_of(Index k, const std::vector<Index>& facets) const {
  std::vector<Index> cells = facets;
  for (Index j = dimension() - 2; j >= k; --j) {
    std::vector<bool> is_there(as_size(count(j + 1)), false);
    for (const Index cell : cells) is_there[as_size(cell)] = true;
    cells.clear();
    for (Index cell = 0; cell < count(j); ++cell)
      for (SparseMatrixXd::InnerIterator it(coboundary(j), cell); it; ++it)
        if (is_there[as_size(it.row())]) {
          cells.push_back(cell);
          break;
        }
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

VectorXd CellComplex::boundary_dual_measures(Index k, const std::vector<Index>& facets) const {
  VectorXd weights = VectorXd::Zero(count(dimension() - 1));
  for (const Index facet : facets) weights[facet] = 1.0;
  return duals(k, dimension() - 1, std::move(weights));
}

VectorXd CellComplex::duals(Index k, Index m, VectorXd weights) const {
  for (Index j = m - 1; j >= k; --j)
    weights = (at(distances_, j).transpose() * weights / static_cast<double>(m - j)).eval();
  return weights;
}

}  // namespace courant
