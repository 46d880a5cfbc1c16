#include "courant/integrators/certificate/natural_scaling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <utility>

#include "courant/core/numbers/uncertain.hpp"

namespace courant {
namespace {

// The components of the bipartite graph of rows and columns, by merging.
class Components {
 public:
  explicit Components(Index size) : parent_(static_cast<std::size_t>(size)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  Index root(Index i) {
    while (parent_[static_cast<std::size_t>(i)] != i) {
      Index& up = parent_[static_cast<std::size_t>(i)];
      up = parent_[static_cast<std::size_t>(up)];
      i = up;
    }
    return i;
  }
  void join(Index i, Index j) { parent_[static_cast<std::size_t>(root(i))] = root(j); }

 private:
  std::vector<Index> parent_;
};

// How large the terms of the equations that an unknown is strong in let it be; infinite where they tell nothing. The
// voltage of a switch that is closed is the difference of two of 3 V, whatever currents elsewhere make of its unit.
VectorXd told_by_terms(const NaturalScaling& units, const Linearization& at) {
  constexpr double strong = 0.1;       // of the strongest in equilibrated equations
  constexpr double round_off = 1e-10;  // in natural units: terms that tell nothing
  constexpr double none = std::numeric_limits<double>::infinity();
  const Index n = units.scaled.cols();
  VectorXd most = VectorXd::Constant(n, none);
  if (at.value_error.size() != at.value.size()) return most;
  for (Index j = 0; j < n; ++j) {
    double strongest = 0.0, told = 0.0;
    for (SparseMatrixXd::InnerIterator it(units.scaled, j); it; ++it)
      strongest = std::max(strongest, std::fabs(it.value()));
    for (SparseMatrixXd::InnerIterator it(units.scaled, j); it; ++it) {
      if (std::fabs(it.value()) < strong * strongest) continue;
      const double derivative =
          std::fabs(it.value()) / (units.row_scale[it.row()] * units.column_scale[j]);
      told = std::max(told, at.value_error[it.row()] / Uncertain::unit / derivative);
    }
    if (told > round_off * units.column_scale[j]) most[j] = told;
  }
  return most;
}

}  // namespace

VectorXd significant(const Linearization& at) {
  if (at.value_error.size() != at.value.size()) return at.value;
  return (at.value.array().abs() <= at.value_error.array()).select(0.0, at.value);
}

NaturalScaling::NaturalScaling(const Linearization& at, const VectorXd& nominal, double noise,
                               double least_size) {
  Equilibration<SparseMatrixXd> equilibrated = equilibrate(at.jacobian, noise);
  scaled = std::move(equilibrated.scaled);
  row_scale = std::move(equilibrated.row_scale);
  column_scale = std::move(equilibrated.column_scale);

  const Index m = scaled.rows(), n = scaled.cols();
  Components components(m + n);
  for (Index j = 0; j < n; ++j)
    for (SparseMatrixXd::InnerIterator it(scaled, j); it; ++it) components.join(it.row(), m + j);
  std::vector<Index> number(static_cast<std::size_t>(m + n), -1);
  const auto component_of = [&](Index vertex) {
    Index& index = number[static_cast<std::size_t>(components.root(vertex))];
    if (index < 0) index = component_count++;
    return index;
  };
  for (Index i = 0; i < m; ++i) row_component.push_back(component_of(i));
  for (Index j = 0; j < n; ++j) column_component.push_back(component_of(m + j));

  VectorXd size = VectorXd::Zero(component_count), number_in = size, inverse_residual = size,
           rounding = size;
  for (Index j = 0; j < n; ++j) {
    const Index component = column_component[static_cast<std::size_t>(j)];
    size[component] = std::max(size[component], nominal[j] / column_scale[j]);
    number_in[component] = std::max(number_in[component], nominal[j]);
  }
  const VectorXd value = significant(at);
  for (Index i = 0; i < m; ++i) {
    double& s = inverse_residual[row_component[static_cast<std::size_t>(i)]];
    s = std::max(s, std::abs(value[i]) * row_scale[i]);
    if (at.value_error.size() != m) continue;
    double& error = rounding[row_component[static_cast<std::size_t>(i)]];
    error = std::max(error, at.value_error[i] * row_scale[i]);
  }
  // Scales divided by less than 10⁻²⁹⁰ leave the range of doubles.
  constexpr double least = 1e-290;
  // Round-off of zeros is small next to the numbers of other components, or to what its equations lack. Lengths that are
  // small in the units of equilibration alone, whose factor nothing tells, may be all that there is.
  const double largest = n == 0 ? 0.0 : nominal.maxCoeff();
  const auto is_zero = [&](Index component) {
    const bool is_round_off = number_in[component] <= least_size * largest ||
                              size[component] <= least_size * inverse_residual[component];
    return size[component] <= least || (size[component] <= least_size && is_round_off);
  };
  // A unit of which rounding errors are not a small part is itself made of them.
  constexpr double seen = 1e3;
  const auto factor = [&](Index component) {
    const bool zero = is_zero(component);
    const double made_of = zero ? inverse_residual[component] : size[component];
    const bool is_unit = made_of > (zero ? std::max(least, least_size) : least);
    return is_unit ? std::max(made_of, seen * rounding[component]) : 1.0;
  };
  for (Index i = 0; i < m; ++i) row_scale[i] /= factor(row_component[static_cast<std::size_t>(i)]);
  for (Index j = 0; j < n; ++j)
    column_scale[j] *= factor(column_component[static_cast<std::size_t>(j)]);
}

double NaturalScaling::defect(const VectorXd& value, const VectorXd& nominal) const {
  const VectorXd residual = row_scale.cwiseProduct(value).cwiseAbs();
  const VectorXd made_of = scaled.cwiseAbs() * nominal.cwiseQuotient(column_scale);
  VectorXd largest = VectorXd::Zero(component_count), scale = VectorXd::Zero(component_count);
  for (Index i = 0; i < residual.size(); ++i) {
    const Index component = row_component[static_cast<std::size_t>(i)];
    largest[component] = std::max(largest[component], residual[i]);
    scale[component] = std::max(scale[component], made_of[i]);
  }
  double worst = 0.0;
  for (Index c = 0; c < component_count; ++c)
    if (largest[c] > 0.0) worst = std::max(worst, scale[c] > 0.0 ? largest[c] / scale[c] : 1.0);
  return worst;
}

SparseMatrixXd generic_magnitude(const LinearizableMap& map, const VectorXd& y,
                                 const VectorXd& nominal, const Linearization& at) {
  constexpr double vanishing = 1e-4;  // in natural units
  constexpr double far = 1e3;
  SparseMatrixXd magnitude = at.jacobian.cwiseAbs();
  std::mt19937 generator(20250613);
  std::uniform_real_distribution<double> uniform(-0.1, 0.1);
  const auto include = [&](const VectorXd& size) {
    const VectorXd nearby =
        y + size.unaryExpr([&](double unit) { return unit * uniform(generator); });
    const SparseMatrixXd there = map(nearby).jacobian.cwiseAbs();
    for (Index k = 0; k < there.nonZeros(); ++k)
      if (!std::isfinite(there.valuePtr()[k])) return;
    magnitude = SparseMatrixXd(magnitude.cwiseMax(there));
  };
  for (int sample = 0; sample < 2; ++sample) include(nominal);
  // An unknown that vanishes at y moves by the unit that the others give it: as many of its column
  // scales as they have on average. Two rounds: entries that vanish at y tell units too.
  for (int round = 0; round < 2; ++round) {
    const NaturalScaling units({at.value, magnitude, at.value_error}, nominal, 1e-9, 1e-10);
    VectorXd count = VectorXd::Zero(units.component_count), logarithm = count;
    const auto component = [&](Index j) {
      return units.column_component[static_cast<std::size_t>(j)];
    };
    const VectorXd size = nominal.cwiseQuotient(units.column_scale);
    for (Index j = 0; j < y.size(); ++j) {
      if (size[j] < vanishing) continue;
      count[component(j)] += 1.0;
      logarithm[component(j)] += std::log(size[j]);
    }
    VectorXd move = nominal;
    const VectorXd most = told_by_terms(units, at);
    for (Index j = 0; j < y.size(); ++j) {
      const Index c = component(j);
      if (size[j] >= vanishing) continue;
      move[j] = units.column_scale[j] * (count[c] > 0.0 ? std::exp(logarithm[c] / count[c]) : 1.0);
      if (move[j] > far * most[j]) move[j] = most[j];
    }
    include(move);
  }
  return magnitude;
}

void keep_what_is_here(SparseMatrixXd& magnitude, const Linearization& at) {
  constexpr double steep = 1e3;
  for (Index j = 0; j < magnitude.outerSize(); ++j)
    for (SparseMatrixXd::InnerIterator it(magnitude, j); it; ++it) {
      const double here = std::fabs(at.jacobian.coeff(it.row(), j));
      const double error = at.error.size() > 0 ? at.error.coeff(it.row(), j) : 0.0;
      if (here > error && it.value() > steep * here) it.valueRef() = here;
    }
}

GenericScaling::GenericScaling(const Prolongation& array, const VectorXd& y,
                               const VectorXd& nominal) {
  Linearization at = array.linearize(y);
  at.value.setZero();  // y is a zero; what is left of the value is no size of anything
  magnitude = array.has_constant_jacobian()
                  ? SparseMatrixXd(at.jacobian.cwiseAbs())
                  : generic_magnitude([&](const VectorXd& there) { return array.linearize(there); },
                                      y, nominal, at);
  Equilibration<SparseMatrixXd> equilibrated = equilibrate(magnitude, 0.0);
  row_scale = std::move(equilibrated.row_scale);
  column_scale = std::move(equilibrated.column_scale);
  scaled = row_scale.asDiagonal() * at.jacobian * column_scale.asDiagonal();
}

}  // namespace courant
