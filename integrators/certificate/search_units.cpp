#include "courant/integrators/certificate/search_units.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace courant {

SearchUnits::SearchUnits(const LinearizableMap& map, const Mobility& mobility, const VectorXd& y,
                         const VectorXd& nominal, const Linearization& at)
    : mobility_(mobility), magnitude_(mobility.magnitude) {
  if (magnitude_.size() == 0) magnitude_ = generic_magnitude(map, y, nominal, at);
}

NaturalScaling SearchUnits::operator()(const Linearization& at, const VectorXd& nominal) {
  magnitude_ = SparseMatrixXd(magnitude_.cwiseMax(SparseMatrixXd(at.jacobian.cwiseAbs())));
  if (mobility_.has_exponentials) keep_exponentials_here(at);
  return NaturalScaling({at.value, magnitude_, at.value_error}, nominal);
}

// Frozen unknowns are no matter of equations that others are in.
void SearchUnits::keep_exponentials_here(const Linearization& at) {
  keep_what_is_here(magnitude_, at);
  std::vector<bool> moves(static_cast<std::size_t>(magnitude_.rows()), false);
  for (Index j = 0; j < magnitude_.outerSize(); ++j)
    for (SparseMatrixXd::InnerIterator it(magnitude_, j); it; ++it)
      if (j >= mobility_.frozen && it.value() > 0.0)
        moves[static_cast<std::size_t>(it.row())] = true;
  magnitude_.prune([&](Index i, Index j, double) {
    return j >= mobility_.frozen || !moves[static_cast<std::size_t>(i)];
  });
}

NaturalScaling with_step_limits(NaturalScaling units, const LinearizableMap& map, const VectorXd& y,
                                const Linearization& at, const Mobility& mobility) {
  constexpr double most = 1e3;
  const SparseMatrixXd here = at.jacobian.cwiseAbs();
  VectorXd largest = VectorXd::Zero(here.rows());  // of a row, in units
  for (Index j = mobility.frozen; j < here.outerSize(); ++j)
    for (SparseMatrixXd::InnerIterator it(here, j); it; ++it)
      largest[it.row()] = std::max(largest[it.row()], it.value() * units.column_scale[j]);
  const auto grows = [&](Index moved, double size) {
    VectorXd there = y;
    there[moved] += size;
    const Linearization next = map(there);
    if (!is_finite(next)) return true;
    for (Index j = mobility.frozen; j < next.jacobian.outerSize(); ++j)
      for (SparseMatrixXd::InnerIterator it(next.jacobian, j); it; ++it)
        if (std::fabs(it.value()) * units.column_scale[j] > most * largest[it.row()]) return true;
    return false;
  };
  for (Index j = mobility.frozen; j < y.size(); ++j) {
    double size = units.column_scale[j];
    for (int k = 0; k < 60 && (grows(j, size) || grows(j, -size)); ++k) size *= 0.25;
    units.column_scale[j] = size;
  }
  return units;
}

}  // namespace courant
