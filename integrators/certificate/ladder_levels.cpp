#include "courant/integrators/certificate/ladder_levels.hpp"

#include <algorithm>
#include <cmath>

#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/integrators/certificate/damped_inverse.hpp"
#include "courant/integrators/certificate/derivative_array.hpp"
#include "courant/integrators/certificate/natural_scaling.hpp"
#include "courant/integrators/certificate/row_reduction.hpp"

namespace courant {
namespace {

double factorial(Index i) { return std::tgamma(static_cast<double>(i) + 1.0); }

// The multipliers of a reduced row as a combination of derivatives, with coefficient 1 for the
// largest of the highest ones. The i-th Taylor coefficient is the i-th derivative by i!. `factor`
// receives what the row is to be multiplied with to fit.
Combination combination(const SparseEntries& multipliers, const VectorXd& row_scale,
                        Index equation_count, double& factor) {
  Combination result;
  Combination::Term lead = {0, -1, 0.0};
  for (const auto& [row, value] : multipliers) {
    const Index i = row / equation_count;
    const Combination::Term term = {row % equation_count, i, value * row_scale[row] / factorial(i)};
    result.terms.push_back(term);
    if (i > lead.derivative ||
        (i == lead.derivative && std::abs(term.coefficient) > std::abs(lead.coefficient)))
      lead = term;
  }
  factor = 1.0 / lead.coefficient;
  for (auto& term : result.terms) term.coefficient *= factor;
  return result;
}

// Whether sums are round-off of their terms.
bool is_negligible(const Eigen::RowVectorXd& size_of_terms, const Eigen::RowVectorXd& sum) {
  return (sum.array().abs() <= 1e-9 * size_of_terms.array()).all();
}

enum Group : Index { higher = 0, auxiliary = 1, velocity = 2, position = 3 };

// The Jacobian at y, reduced: jets first, the point last.
RowReduction reduced(const DerivativeArray& array, const VectorXd& y,
                     const ComparableJacobian& units,
                     RowReduction::Pivots pivots = RowReduction::Pivots::sparse) {
  const Index n = array.base_size(), m = array.auxiliary_size(), r = array.equation_count();
  std::vector<Index> row_level, column_group;
  for (Index i = 0; i < array.row_count(array.level_of(y)); ++i) row_level.push_back(i / r);
  for (Index j = 0; j < y.size(); ++j)
    column_group.push_back(j < n           ? position
                           : j < 2 * n     ? velocity
                           : j < 2 * n + m ? auxiliary
                                           : higher);
  return RowReduction(units.scaled, row_level, column_group, pivots);
}

// Where elimination counts other ranks than the singular values, in words; empty where they agree.
std::string disagreement(const LadderLevel& level, const RowReduction& reduction) {
  Index count = 0;
  for (const Group g : {higher, auxiliary, velocity, position}) {
    for (const RowReduction::Row& row : reduction.group(g))
      if (row.level <= level.k) ++count;
    const RankDecision* decision = g == auxiliary  ? &level.without_tangent
                                   : g == velocity ? &level.without_point
                                   : g == position ? &level.all
                                                   : nullptr;
    if (decision && decision->rank != count)
      return "At level " + std::to_string(level.k) + " elimination counts rank " +
             std::to_string(count) + " where singular values count " +
             std::to_string(decision->rank) + ".";
  }
  return "";
}

std::vector<std::string> disagreements(const std::vector<LadderLevel>& levels,
                                       const RowReduction& reduction) {
  std::vector<std::string> result;
  for (const LadderLevel& level : levels)
    if (std::string doubt = disagreement(level, reduction); !doubt.empty())
      result.push_back(std::move(doubt));
  return result;
}

std::vector<int> needed_differentiations(const RowReduction& reduction, Index equation_count,
                                         Index index) {
  std::vector<int> result(static_cast<std::size_t>(equation_count), 0);
  for (const Group g : {velocity, position})
    for (const RowReduction::Row& row : reduction.group(g)) {
      if (row.level > index) continue;
      for (const auto& [i, value] : row.multipliers) {
        int& count = result[static_cast<std::size_t>(i % equation_count)];
        count = std::max(count, static_cast<int>(i / equation_count));
      }
    }
  return result;
}

}  // namespace

ComparableJacobian::ComparableJacobian(const Prolongation& array, const VectorXd& y,
                                       const VectorXd& uncertainty) {
  const Linearization at = array.linearize(y, uncertainty.cwiseMax(Prolongation::rounding(y)));
  Equilibration<SparseMatrixXd> equilibrated = equilibrate(at.jacobian, 0.0);
  row_scale = std::move(equilibrated.row_scale);
  column_scale = std::move(equilibrated.column_scale);
  scaled = {std::move(equilibrated.scaled),
            row_scale.asDiagonal() * at.error * column_scale.asDiagonal()};
}

std::vector<LadderLevel> ladder_levels(const Prolongation& array, const VectorXd& y,
                                       const VectorXd& uncertainty) {
  const Index n = array.base_size();
  const Linearization at = array.linearize(y, uncertainty.cwiseMax(Prolongation::rounding(y)));
  const UncertainMatrix jacobian{at.jacobian, at.error};
  constexpr double solved = 10.0;  // times what rounding and the uncertainty of y make of F
  std::vector<LadderLevel> levels;
  for (Index k = 0; k <= array.level_of(y); ++k) {
    const Index rows = array.row_count(k), columns = array.unknown_count(k);
    const auto rank_from = [&](Index first) {
      return decide_rank(jacobian.block(0, first, rows, columns - first));
    };
    LadderLevel level;
    level.k = k;
    level.all = rank_from(0);
    level.without_tangent = rank_from(2 * n);
    level.without_point = rank_from(n);
    level.dim_S = 2 * n - level.all.rank + level.without_tangent.rank;
    level.dim_M = n - level.all.rank + level.without_point.rank;
    level.residual = rows == 0 ? 0.0 : at.value.head(rows).lpNorm<Eigen::Infinity>();
    level.is_solved =
        (at.value.head(rows).cwiseAbs().array() <= solved * at.value_error.head(rows).array())
            .all();
    levels.push_back(std::move(level));
  }
  return levels;
}

std::vector<int> needed_differentiations(const DerivativeArray& array, const VectorXd& y,
                                         const VectorXd& uncertainty, Index index) {
  const ComparableJacobian units(array, y, uncertainty);
  return needed_differentiations(reduced(array, y, units), array.equation_count(), index);
}

void describe(ConstraintLadder& ladder, const DerivativeArray& array, const VectorXd& y,
              const VectorXd& uncertainty) {
  constexpr Index dense_limit = 200;
  const Index n = array.base_size(), m = array.auxiliary_size(), r = array.equation_count();
  const ComparableJacobian units(array, y, uncertainty);
  RowReduction reduction = reduced(array, y, units);
  std::vector<std::string> doubts = disagreements(ladder.levels, reduction);
  if (!doubts.empty() && y.size() <= dense_limit) {
    RowReduction careful = reduced(array, y, units, RowReduction::Pivots::largest);
    if (disagreements(ladder.levels, careful).empty()) {
      reduction = std::move(careful);
      doubts.clear();
    }
  }
  const LinearMap<double>& basis = array.basis();
  const LinearMap<double> absolute_basis = absolute(basis);

  ladder.differentiations = needed_differentiations(reduction, r, ladder.index);

  for (const RowReduction::Row& row : reduction.group(position)) {
    double factor = 1.0;
    const Combination origin = combination(row.multipliers, units.row_scale, r, factor);
    VectorXd gradient = VectorXd::Zero(n), error = VectorXd::Zero(n);
    for (const auto& [j, value] : row.entries) gradient[j] = factor * value / units.column_scale[j];
    for (const auto& [j, bound] : row.errors)
      if (j < n) error[j] = std::fabs(factor) * bound / units.column_scale[j];
    ladder.constraints.push_back({row.level, basis * gradient, origin, absolute_basis * error});
  }
  for (const RowReduction::Row& row : reduction.zero_rows()) {
    double factor = 1.0;
    ladder.redundancies.push_back(combination(row.multipliers, units.row_scale, r, factor));
  }

  ladder.doubts.insert(ladder.doubts.end(), doubts.begin(), doubts.end());

  // The velocities that remain free, one for each column without pivot; columns in the chart.
  const std::vector<RowReduction::Row>& velocities = reduction.reduced_group(velocity);
  std::vector<bool> free(static_cast<std::size_t>(2 * n + m), true);
  for (const auto& row : velocities) free[static_cast<std::size_t>(row.pivot)] = false;
  MatrixXd gauge(n, 0);
  for (Index f = n; f < 2 * n; ++f) {
    if (!free[static_cast<std::size_t>(f)]) continue;
    VectorXd direction = VectorXd::Zero(n);
    direction[f - n] = 1.0;
    for (const auto& row : velocities)
      for (const auto& [j, value] : row.entries)
        if (j == f)
          direction[row.pivot - n] = -value * units.column_scale[row.pivot] / units.column_scale[f];
    gauge.conservativeResize(Eigen::NoChange, gauge.cols() + 1);
    gauge.rightCols(1) = direction;
  }
  ladder.gauge_directions = basis * gauge;
  const MatrixXd terms = absolute_basis * gauge.cwiseAbs();
  ladder.determined_velocities.resize(static_cast<std::size_t>(basis.rows()));
  for (Index i = 0; i < basis.rows(); ++i)
    ladder.determined_velocities[static_cast<std::size_t>(i)] =
        is_negligible(terms.row(i), ladder.gauge_directions.row(i));

  // An auxiliary unknown is determined if its reduced row contains no other one that is free and
  // does not change along the free velocities.
  const std::vector<RowReduction::Row>& auxiliaries = reduction.reduced_group(auxiliary);
  for (const auto& row : auxiliaries) free[static_cast<std::size_t>(row.pivot)] = false;
  ladder.determined.assign(static_cast<std::size_t>(m), false);
  for (const auto& row : auxiliaries) {
    bool determined = true;
    Eigen::RowVectorXd change = Eigen::RowVectorXd::Zero(gauge.cols()), size = change;
    for (const auto& [j, value] : row.entries) {
      if (j >= 2 * n && j != row.pivot && free[static_cast<std::size_t>(j)]) determined = false;
      if (j < n || j >= 2 * n) continue;
      const Eigen::RowVectorXd term = value / units.column_scale[j] * gauge.row(j - n);
      change += term;
      size += term.cwiseAbs();
    }
    ladder.determined[static_cast<std::size_t>(row.pivot - 2 * n)] =
        determined && is_negligible(size, change);
  }
}

TangentDisplacement::TangentDisplacement(const DerivativeArray& array, const VectorXd& y,
                                         const VectorXd& nominal)
    : generator_(1) {
  const Linearization at = array.linearize(y);
  magnitude_ = GenericScaling(array, y, nominal).magnitude;
  if (array.has_exponentials()) keep_what_is_here(magnitude_, at);
  const NaturalScaling scaling({VectorXd::Zero(at.value.size()), magnitude_}, nominal, 0.0, 1e-10);
  units_ = scaling.column_scale;
  const Index n = array.base_size();
  if (n > 0)
    time_unit_ = std::exp((units_.head(n).array() / units_.segment(n, n).array()).log().mean());
  // What was met on the way to y is no size of it; a point in the chart is one next to its origin.
  sizes_ = y.cwiseAbs();
  sizes_.head(n) = nominal.head(n);
  jacobian_ = scaling.row_scale.asDiagonal() * at.jacobian;
}

VectorXd TangentDisplacement::random() {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  return VectorXd::NullaryExpr(units_.size(), [&] { return uniform(generator_); });
}

VectorXd TangentDisplacement::next() {
  const VectorXd direction = random();
  return units_.cwiseProduct(
      kernel_part(SparseMatrixXd(jacobian_ * units_.asDiagonal()), direction));
}

VectorXd TangentDisplacement::next_at_zero(Units of) {
  constexpr double vanishing = 1e-10, far = 6.0, round_off = 1e-14;
  const VectorXd direction = random();
  std::uniform_real_distribution<double> exponent(0.0, far);
  VectorXd units = units_;
  for (Index j = 0; j < units.size() && of != Units::natural; ++j) {
    const bool vanishes = sizes_[j] <= vanishing * units_[j];
    if (of == Units::own_sizes && !vanishes) units[j] = std::min(units_[j], sizes_[j]);
    if (of == Units::large_where_zero && vanishes) units[j] *= std::pow(10.0, exponent(generator_));
  }
  const SparseMatrixXd S = jacobian_ * units.asDiagonal();
  // The second time takes away what rounding has left of the first.
  const VectorXd part = kernel_part(S, kernel_part(S, direction));
  const double least = round_off * direction.norm();
  return units.cwiseProduct(
      part.unaryExpr([&](double entry) { return std::fabs(entry) > least ? entry : 0.0; }));
}

}  // namespace courant
