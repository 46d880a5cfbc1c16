#include "courant/integrators/step/kinetic_units.hpp"

#include <algorithm>
#include <cmath>

#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/integrators/certificate/derivative_array.hpp"
#include "courant/integrators/step/kinetic_metric.hpp"
#include "courant/integrators/step/natural_units.hpp"
#include "courant/manifolds/cotangent_bundle.hpp"

namespace courant {

std::optional<VectorXd> kinetic_masses(const std::shared_ptr<const ImplicitSystem>& system,
                                       const VectorXd& x) {
  const auto bundle = std::dynamic_pointer_cast<const CotangentBundle>(system->manifold());
  if (!bundle) return std::nullopt;
  const auto metric = kinetic_metric(system, MomentumProjector::momenta_of(*bundle), x);
  if (!metric) return std::nullopt;
  return VectorXd(values(metric->lower(constants(x))).diagonal());
}

VectorXd kinetic_sizes(const Manifold& phase_space, const VectorXd& masses, const VectorXd& x,
                       double h) {
  const VectorXd root = masses.cwiseSqrt();
  VectorXd tangent(2 * root.size());
  tangent << root.cwiseInverse(), root / std::fabs(h);
  const Manifold::ScalingSymmetries scaling = phase_space.scaling_symmetries();
  const VectorXd sizes =
      by_number(scaling.point,
                largest_by_number(scaling.tangent, tangent,
                                  Manifold::ScalingSymmetries::after(scaling.point)),
                0.0);
  double largest = 0.0;
  for (Index i = 0; i < sizes.size(); ++i)
    if (sizes[i] > 0.0) largest = std::max(largest, std::fabs(x[i]) / sizes[i]);
  return largest > 0.0 ? VectorXd(largest * sizes) : sizes;
}

double spread(const VectorXd& sizes) {
  const double largest = sizes.size() == 0 ? 0.0 : sizes.maxCoeff();
  double smallest = largest;
  for (const double size : sizes)
    if (size > 0.0) smallest = std::min(smallest, size);
  return largest > 0.0 ? largest / smallest : 1.0;
}

namespace {

// The least size in which an unknown fills an equation of these sizes; 0 where none of them contains it.
double filling_size(const SparseMatrixXd& magnitude, Index column, const VectorXd& rows) {
  double least = 0.0;
  for (SparseMatrixXd::InnerIterator it(magnitude, column); it; ++it) {
    if (!(it.value() > 0.0) || !(rows[it.row()] > 0.0)) continue;
    const double size = rows[it.row()] / it.value();
    if (least == 0.0 || size < least) least = size;
  }
  return least;
}

}  // namespace

Units kinetic_units(const std::shared_ptr<const ImplicitSystem>& system, const State& point,
                    const VectorXd& sizes, double h) {
  const Manifold& M = *system->manifold();
  const DerivativeArray array(system, point.t, point.x);
  const SparseMatrixXd magnitude = array.linearize(array.jet(point.v, point.z)).jacobian.cwiseAbs();
  const Index n = array.base_size(), m = array.auxiliary_size();

  Units units = units_by_sizes(M, sizes);
  units.time = unit_next_to(std::fabs(h));
  const VectorXd chart = chart_units(units, M, point.x);
  VectorXd columns = VectorXd::Zero(2 * n + m);
  columns.head(2 * n) << chart, chart / units.time;
  // From equations of coordinates alone to those of unknowns that these tell.
  for (bool is_told = true; is_told;) {
    is_told = false;
    const VectorXd rows = largest_of_rows(SparseMatrixXd(magnitude * columns.asDiagonal()));
    for (Index j = 2 * n; j < columns.size(); ++j) {
      if (columns[j] > 0.0) continue;
      columns[j] = filling_size(magnitude, j, rows);
      is_told |= columns[j] > 0.0;
    }
  }
  units.auxiliary = columns.tail(m).unaryExpr(&unit_next_to);
  columns.tail(m) = units.auxiliary;
  units.equations = equation_units(*system, SparseMatrixXd(magnitude * columns.asDiagonal()));
  return units;
}

}  // namespace courant
