#include "courant/integrators/step/natural_units.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <random>
#include <utility>

#include "courant/core/numbers/power_of_two.hpp"
#include "courant/integrators/certificate/derivative_array.hpp"
#include "courant/integrators/certificate/dimensionless_arguments.hpp"
#include "courant/integrators/certificate/natural_scaling.hpp"
#include "courant/integrators/step/unit_equations.hpp"

namespace courant {
namespace {

// Beyond so many rows and columns scales are powers of two: the linear system would take long.
constexpr Index kExact = 500;
// Entries below this, where rows and columns are levelled, are no units, unless all are to count.
constexpr double kLeastEntry = 1e-9;

// Numbers that are zero come out of the search for a consistent point as what it leaves of the others:
// those below this part of the largest of their kind, as they are and in units, say nothing about a
// size.
constexpr double kZero = 1e-9;

VectorXd without_zeros(const VectorXd& sizes) {
  if (sizes.size() == 0) return sizes;
  const double least = kZero * sizes.maxCoeff();
  return (sizes.array() > least).select(sizes, 0.0);
}

// The sizes of the unknowns of level 0 at the jet y, 0 where they are zero but for round-off: of the
// coordinates, since those of the chart are 0, and of the rates next to each other; of an auxiliary
// unknown next to the coordinates, rates and constants that it meets in an equation.
VectorXd known_sizes(const DerivativeArray& array, const VectorXd& y) {
  const Index n = array.base_size();
  VectorXd sizes = VectorXd::Zero(y.size());
  sizes.head(n) = without_zeros(array.origin_size());
  sizes.segment(n, n) = without_zeros(y.segment(n, n).cwiseAbs());
  const VectorXd without_unknowns = (sizes.array() > 0.0).select(y, 0.0);
  // Equations that divide by an unknown are not finite here, and say nothing.
  const Linearization known = array.linearize(without_unknowns);
  const SparseMatrixXd terms = known.jacobian.cwiseAbs();
  const VectorXd least = kZero * (known.value.cwiseAbs() + terms * sizes);
  const VectorXd unknowns = without_zeros(y.tail(y.size() - 2 * n).cwiseAbs());
  for (Index j = 2 * n; j < y.size(); ++j)
    for (SparseMatrixXd::InnerIterator it(terms, j); it; ++it)
      if (least[it.row()] > 0.0 && it.value() * unknowns[j - 2 * n] > least[it.row()])
        sizes[j] = unknowns[j - 2 * n];
  return sizes;
}

using Numbering = UnitNumbering;

// The units of the columns of this magnitude by UnitEquations: entries that are at least `least` in these natural
// units, what the equations contain besides where that is not 0, and the arguments of functions at the point
// (x, v, z, t).
VectorXd column_units(const SparseMatrixXd& magnitude, const NaturalScaling& natural, double least,
                      const VectorXd& constants, const DimensionlessArguments* arguments,
                      const VectorXd& point, const Numbering& numbering, const VectorXd& nominal) {
  UnitEquations equations(numbering, magnitude.rows(), magnitude.cols());
  for (Index j = 0; j < magnitude.cols(); ++j)
    for (SparseMatrixXd::InnerIterator it(magnitude, j); it; ++it)
      if (!(natural.row_scale[it.row()] * it.value() * natural.column_scale[j] < least))
        equations.add_entry(it.row(), j, it.value());
  for (Index i = 0; i < constants.size(); ++i)
    if (constants[i] > 0.0) equations.add_constant(i, constants[i]);
  if (arguments)
    for (const auto& slope : arguments->slopes(point))
      equations.add_slope(slope.unknown, slope.size);
  return equations.columns(nominal);
}

// What tells units.
enum class Evidence {
  usual,  // entries and sizes that are no small part of others
  all,  // small entries too that are more than rounding errors, and what equations contain besides
};

// |∂F_i/∂y_j| at y, of all evidence where it is more than rounding errors.
SparseMatrixXd magnitude_at(const DerivativeArray& array, const VectorXd& y, Evidence evidence) {
  const Linearization at = array.linearize(y);
  SparseMatrixXd magnitude = at.jacobian.cwiseAbs();
  if (evidence == Evidence::all && at.error.size() > 0)
    magnitude.prune([&](Index i, Index j, double value) { return value > at.error.coeff(i, j); });
  return magnitude;
}

// The largest |∂F_i/∂y_j| at y and at points that are up to these moves away, or to a tenth of them.
SparseMatrixXd magnitude_near(const DerivativeArray& array, const VectorXd& y,
                              const VectorXd& moves, Evidence evidence) {
  SparseMatrixXd magnitude = magnitude_at(array, y, evidence);
  if (array.has_constant_jacobian()) return magnitude;
  std::mt19937 generator(20250613);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int sample = 0; sample < 4; ++sample) {
    const double part = sample < 2 ? 1.0 : 0.1;
    const VectorXd nearby =
        y + moves.unaryExpr([&](double move) { return part * move * uniform(generator); });
    const SparseMatrixXd there = magnitude_at(array, nearby, evidence);
    const Eigen::Map<const VectorXd> entries(there.valuePtr(), there.nonZeros());
    if (entries.allFinite()) magnitude = SparseMatrixXd(magnitude.cwiseMax(there));
  }
  return magnitude;
}

// |F_i| at y, 0 where that is a small part of the terms of F_i.
VectorXd constants_at(const DerivativeArray& array, const VectorXd& y, const VectorXd& nominal) {
  const Linearization at = array.linearize(y);
  const VectorXd least = kZero * (at.jacobian.cwiseAbs() * nominal) + at.value_error;
  return (at.value.array().abs() > least.array()).select(at.value.cwiseAbs(), 0.0);
}

// The components of unknowns and of equations, those of a coordinate and of its rate as one.
struct JoinedComponents {
  std::vector<Index> columns, rows;
};
JoinedComponents components_with_rates(const NaturalScaling& natural, Index n) {
  JoinedComponents all{natural.column_component, natural.row_component};
  for (Index j = 0; j < n; ++j) {
    const Index rate = all.columns[static_cast<std::size_t>(n + j)],
                coordinate = all.columns[static_cast<std::size_t>(j)];
    std::ranges::replace(all.columns, rate, coordinate);
    std::ranges::replace(all.rows, rate, coordinate);
  }
  return all;
}

// Nothing tells the factor of units of what has no connection with any known size or constant, as of a second
// particle at rest: that of its largest coordinate becomes that of the others.
void align_components(VectorXd& units, const NaturalScaling& natural, const VectorXd& constants,
                      const Numbering& numbering, const VectorXd& nominal) {
  const Index n = std::ssize(numbering);
  const auto [columns, rows] = components_with_rates(natural, n);
  const auto of = [](const std::vector<Index>& components, Index i) {
    return components[static_cast<std::size_t>(i)];
  };
  VectorXd known = VectorXd::Zero(natural.component_count), largest = known;
  for (Index i = 0; i < constants.size(); ++i)
    if (constants[i] > 0.0) known[of(rows, i)] = 1.0;
  for (Index j = 0; j < units.size(); ++j)
    if (nominal[j] > 0.0) known[of(columns, j)] = 1.0;
  for (Index j = 0; j < n; ++j)
    if (numbering[static_cast<std::size_t>(j)] == Manifold::ScalingSymmetries::none)
      known[of(columns, j)] = 1.0;
  for (Index j = 0; j < n; ++j)
    largest[of(columns, j)] = std::max(largest[of(columns, j)], units[j]);
  const double size = known.cwiseProduct(largest).maxCoeff();
  if (!(size > 0.0)) return;
  for (Index j = 0; j < units.size(); ++j) {
    const Index c = of(columns, j);
    if (known[c] == 0.0 && largest[c] > 0.0) units[j] *= size / largest[c];
  }
}

// Units of all unknowns of level 0, near the jet y. `nominal`: their sizes, 0 where they are zero but for
// round-off. What vanishes at y is as large as it is nearby: numbers differ by parts of their sizes,
// and zeros by parts of their units, which is why there are several rounds. Where those of all evidence do not settle,
// as where a unit is made of nothing but itself, they are empty, or the first ones beside coordinates without a unit.
VectorXd units_near(const DerivativeArray& array, const VectorXd& y, const VectorXd& nominal,
                    const Numbering& numbering, Evidence evidence,
                    const DimensionlessArguments* arguments) {
  constexpr double settled = 0.1;  // a small part of a power of two
  const bool is_all = evidence == Evidence::all;
  const int rounds = is_all ? 60 : 4;
  const double least = is_all ? 0.0 : kLeastEntry;
  const VectorXd at = (nominal.array() > 0.0).select(y, 0.0);
  const VectorXd constants =
      is_all ? constants_at(array, at, nominal) : VectorXd(VectorXd::Zero(array.equation_count()));
  VectorXd moves = 0.1 * nominal, units, first;
  // (x, v, z, t) a little away, where M has coordinates of its own.
  const auto point_nearby = [&] {
    VectorXd point(y.size() + 1);
    point << at + 0.5 * moves, array.t();
    point.head(array.base_size()) += array.basis().transpose() * array.origin();
    return point;
  };
  for (int round = 0; round < rounds; ++round) {
    const SparseMatrixXd magnitude = magnitude_near(array, at, moves, evidence);
    const bool is_large = magnitude.rows() + magnitude.cols() > kExact;
    const NaturalScaling natural({VectorXd::Zero(magnitude.rows()), magnitude}, nominal, least,
                                 1e-10);
    const VectorXd before = std::exchange(
        units, is_large
                   ? natural.column_scale
                   : column_units(magnitude, natural, least, constants, arguments,
                                  arguments ? point_nearby() : VectorXd(), numbering, nominal));
    if (is_all) align_components(units, natural, constants, numbering, nominal);
    if (round == 0) first = units;
    if (array.has_constant_jacobian()) return units;
    if (is_all && round > 0 && (units.array() / before.array()).log().abs().maxCoeff() < settled)
      return units;
    moves = (nominal.array() > 0.0).select(0.1 * nominal, units);
  }
  if (!is_all) return units;
  // Of a body that nothing but its inertia acts on, rounds make velocities smaller and smaller. Where coordinates are
  // numbers without a unit these tell enough at first.
  return std::ranges::count(numbering, Manifold::ScalingSymmetries::none) > 0 ? first : VectorXd();
}

// Each coordinate has a unit of its own.
Numbering each(const DerivativeArray& array) {
  Numbering numbers(static_cast<std::size_t>(array.base_size()));
  std::iota(numbers.begin(), numbers.end(), Index{0});
  return numbers;
}

// Those of the scaling symmetries of M. Empty where a coordinate of the chart is along tangent vectors of several
// units.
Numbering of_scaling_symmetries(const Manifold& M, const DerivativeArray& array) {
  constexpr double nothing = 1e-12;
  const std::vector<Index> tangent = M.scaling_symmetries().tangent;
  const MatrixXd basis = array.basis().matrix();
  Numbering numbers(static_cast<std::size_t>(basis.cols()));
  for (Index j = 0; j < basis.cols(); ++j) {
    Index largest = 0;
    basis.col(j).cwiseAbs().maxCoeff(&largest);
    const Index number = numbers[static_cast<std::size_t>(j)] =
        tangent[static_cast<std::size_t>(largest)];
    for (Index i = 0; i < basis.rows(); ++i)
      if (std::abs(basis(i, j)) > nothing && tangent[static_cast<std::size_t>(i)] != number)
        return {};
  }
  return numbers;
}

// Points and vectors are their own coordinates, as on Rⁿ, tori and their bundles.
bool is_its_own_chart(const Manifold& M) {
  return M.dimension() == M.ambient_dimension() && M.dimension() == M.tangent_dimension();
}

// Level 0 at a point, and the units of its unknowns (ξ, ξ', z).
struct Level0 {
  DerivativeArray array;
  Numbering numbering;  // of the coordinates of the chart; without one there are no units
  VectorXd y, units;    // no units where all evidence tells none

  Level0(DerivativeArray at, const State& point, Evidence evidence,
         const std::function<Numbering(const DerivativeArray&)>& numbering_of)
      // The equations themselves: higher derivatives are not all determined, and what an iteration made
      // of those that are not has no units of its own.
      : array(std::move(at)), numbering(numbering_of(array)), y(array.jet(point.v, point.z)) {
    if (numbering.empty() || (evidence == Evidence::all && array.has_exponentials())) return;
    std::optional<DimensionlessArguments> known;
    const ImplicitSystem& system = *array.system();
    if (evidence == Evidence::all && is_its_own_chart(*system.manifold())) known.emplace(system);
    const DimensionlessArguments* arguments = known ? &*known : nullptr;
    const VectorXd nominal = known_sizes(array, y);
    units = units_near(array, y, nominal, numbering, evidence, arguments);
    if (units.size() == 0) return;
    const VectorXd seen = without_zeros(nominal.cwiseQuotient(units)).cwiseProduct(units);
    if ((seen.array() > 0.0).count() < (nominal.array() > 0.0).count())
      units = units_near(array, y, (seen.array() > 0.0).select(nominal, 0.0), numbering, evidence,
                         arguments);
  }
};

// `numbers` with 0 for those that are round-off next to the largest of them.
VectorXd without_round_off(const VectorXd& numbers) {
  constexpr double round_off = 1e-14;
  if (numbers.size() == 0) return numbers;
  const double least = round_off * numbers.lpNorm<Eigen::Infinity>();
  return (numbers.array().abs() > least).select(numbers, 0.0);
}

// Takes these sizes of coordinates for units; 0 is none.
void measure_coordinates(const Manifold& M, const VectorXd& coordinates, Units& units) {
  const Manifold::ScalingSymmetries scaling = M.scaling_symmetries();
  const VectorXd unit = largest_by_number(scaling.point, coordinates,
                                          Manifold::ScalingSymmetries::after(scaling.point));
  const auto measure = [&](const Numbering& numbers, VectorXd& sizes) {
    const VectorXd given = by_number(numbers, unit, 0.0);
    for (Index i = 0; i < given.size(); ++i)
      if (given[i] > 0.0) sizes[i] = unit_next_to(given[i]);
  };
  measure(scaling.point, units.coordinates);
  measure(scaling.tangent, units.tangent);
}

}  // namespace

State without_round_off(const std::shared_ptr<const ChartEquations>& equations,
                        const State& point) {
  const ImplicitSystem& system = *equations->system();
  State zeroed = point;
  zeroed.x = without_round_off(point.x);
  zeroed.v = without_round_off(point.v);
  const Manifold& M = *system.manifold();
  const Index n = M.dimension(), unknowns = 2 * n + system.auxiliary_size();
  if ((zeroed.x == point.x && zeroed.v == point.v) || !M.has_identity_frame() ||
      unknowns + system.equation_count() > kExact)
    return point;
  const DerivativeArray array(equations, zeroed.t, zeroed.x);
  VectorXd y = array.jet(zeroed.v, zeroed.z);
  const SparseMatrixXd terms = magnitude_at(array, y, Evidence::all);
  const NaturalScaling natural({VectorXd::Zero(terms.rows()), terms}, VectorXd::Zero(y.size()));
  const std::vector<Index> component = components_with_rates(natural, n).columns;
  y.head(n) = zeroed.x;
  VectorXd largest = VectorXd::Zero(natural.component_count);
  for (Index j = 0; j < y.size(); ++j) {
    double& size = largest[component[static_cast<std::size_t>(j)]];
    size = std::max(size, std::fabs(y[j]));
  }
  for (Index j = 0; j < n; ++j) {
    if (!(largest[component[static_cast<std::size_t>(j)]] > 0.0)) continue;
    zeroed.x[j] = point.x[j];
    if (zeroed.v.size() > 0) zeroed.v[j] = point.v[j];
  }
  return zeroed;
}

VectorXd natural_units(const std::shared_ptr<const ImplicitSystem>& system,
                       const ConstraintLadder& ladder) {
  const Manifold& M = *system->manifold();
  const Index n = M.dimension(), size = M.tangent_dimension();
  if (ladder.point.x.size() == 0 || n == 0) return VectorXd::Ones(size);
  const Level0 level({system, ladder.point.t, ladder.point.x}, ladder.point, Evidence::usual, each);
  const DerivativeArray& array = level.array;
  VectorXd units = level.units.head(n);
  if (n == size) return units;
  // The geometric mean over a block, weighted with what each basis vector has in it.
  const std::vector<Index> block = M.mixed_components();
  VectorXd weight = VectorXd::Zero(size), logarithm = weight, result(size);
  for (Index i = 0; i < size; ++i)
    for (Index j = 0; j < n; ++j) {
      const double share = std::pow(array.basis()(i, j), 2);
      weight[block[static_cast<std::size_t>(i)]] += share;
      logarithm[block[static_cast<std::size_t>(i)]] += share * std::log(units[j]);
    }
  for (Index i = 0; i < size; ++i) {
    const Index b = block[static_cast<std::size_t>(i)];
    result[i] = weight[b] > 0.0 ? std::exp(logarithm[b] / weight[b]) : 1.0;
  }
  return result;
}

std::optional<Units> units_of_all_terms(const std::shared_ptr<const ChartEquations>& equations,
                                        const State& point) {
  const ImplicitSystem& system = *equations->system();
  const Manifold& M = *system.manifold();
  const Manifold::ScalingSymmetries scaling = M.scaling_symmetries();
  const Index unknowns = 2 * M.dimension() + system.auxiliary_size();
  if (Manifold::ScalingSymmetries::after(scaling.point) == 0 || point.x.size() == 0 ||
      unknowns + system.equation_count() > kExact)
    return std::nullopt;
  const Level0 level({equations, point.t, point.x}, point, Evidence::all,
                     [&](const DerivativeArray& array) { return of_scaling_symmetries(M, array); });
  if (level.units.size() == 0) return std::nullopt;
  const SparseMatrixXd terms =
      magnitude_near(level.array, level.y, 0.1 * level.units, Evidence::all) *
      level.units.asDiagonal();
  const Index n = level.array.base_size();
  // By number; 1 of what none of the n coordinates has.
  VectorXd unit = VectorXd::Ones(Manifold::ScalingSymmetries::after(scaling.point));
  for (Index j = 0; j < n; ++j)
    if (const Index number = level.numbering[static_cast<std::size_t>(j)];
        number != Manifold::ScalingSymmetries::none)
      unit[number] = unit_next_to(level.units[j]);
  return Units{.coordinates = by_number(scaling.point, unit, 1.0),
               .tangent = by_number(scaling.tangent, unit, 1.0),
               .auxiliary = level.units.tail(system.auxiliary_size()).unaryExpr(&unit_next_to),
               .equations = equation_units(system, terms),
               .time = unit_next_to(level.units[0] / level.units[n])};
}

double unit_next_to(double size) {
  return size > 0.0 && std::isfinite(size) ? nearest_power_of_two(size) : 1.0;
}

VectorXd largest_by_number(const std::vector<Index>& numbers, const VectorXd& sizes, Index count) {
  VectorXd largest = VectorXd::Zero(count);
  for (Index i = 0; i < sizes.size(); ++i)
    if (const Index number = numbers[static_cast<std::size_t>(i)];
        number != Manifold::ScalingSymmetries::none && sizes[i] > largest[number])
      largest[number] = sizes[i];
  return largest;
}

VectorXd by_number(const std::vector<Index>& numbers, const VectorXd& of_number, double without) {
  VectorXd entries(std::ssize(numbers));
  for (std::size_t i = 0; i < numbers.size(); ++i)
    entries[static_cast<Index>(i)] =
        numbers[i] == Manifold::ScalingSymmetries::none ? without : of_number[numbers[i]];
  return entries;
}

VectorXd largest_of_rows(const SparseMatrixXd& matrix) {
  VectorXd largest = VectorXd::Zero(matrix.rows());
  for (Index j = 0; j < matrix.outerSize(); ++j)
    for (SparseMatrixXd::InnerIterator it(matrix, j); it; ++it)
      largest[it.row()] = std::max(largest[it.row()], it.value());
  return largest;
}

VectorXd equation_units(const ImplicitSystem& system, const SparseMatrixXd& terms) {
  const Manifold& M = *system.manifold();
  VectorXd largest = largest_of_rows(terms);
  // Vectors and covectors stay what they are.
  const std::vector<Index> mixed = M.mixed_components();
  const Index entries = M.tangent_dimension();
  for (Index first = 0; first < system.tangent_blocks() * entries; first += entries) {
    VectorXd shared = VectorXd::Zero(entries);
    for (Index i = 0; i < entries; ++i) {
      double& size = shared[mixed[static_cast<std::size_t>(i)]];
      size = std::max(size, largest[first + i]);
    }
    for (Index i = 0; i < entries; ++i)
      largest[first + i] = shared[mixed[static_cast<std::size_t>(i)]];
  }
  return largest.unaryExpr(&unit_next_to);
}

Units units_by_sizes(const Manifold& M, const VectorXd& coordinates) {
  Units units{.coordinates = VectorXd::Ones(M.ambient_dimension()),
              .tangent = VectorXd::Ones(M.tangent_dimension()),
              .auxiliary = {},
              .equations = {}};
  measure_coordinates(M, coordinates, units);
  return units;
}

Units units_by_sizes(const std::shared_ptr<const ImplicitSystem>& system, const State& point,
                     const VectorXd& coordinates, const VectorXd& unknowns,
                     std::optional<Units> others) {
  const Manifold& M = *system->manifold();
  Units units = others ? *std::move(others)
                       : Units{.coordinates = VectorXd::Ones(M.ambient_dimension()),
                               .tangent = VectorXd::Ones(M.tangent_dimension()),
                               .auxiliary = VectorXd::Ones(system->auxiliary_size()),
                               .equations = VectorXd::Ones(system->equation_count())};
  measure_coordinates(M, coordinates, units);
  for (Index i = 0; i < unknowns.size(); ++i)
    if (unknowns[i] > 0.0) units.auxiliary[i] = unit_next_to(unknowns[i]);

  const DerivativeArray array(system, point.t, point.x);
  const VectorXd chart = chart_units(units, M, point.x);
  VectorXd columns(2 * array.base_size() + array.auxiliary_size());
  columns << chart, chart / units.time, units.auxiliary;
  const SparseMatrixXd terms =
      magnitude_near(array, array.jet(point.v, point.z), 0.1 * columns, Evidence::usual) *
      columns.asDiagonal();
  units.equations = equation_units(*system, terms);
  return units;
}

}  // namespace courant
