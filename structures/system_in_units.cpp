#include "courant/structures/system_in_units.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace courant {
namespace {

void check_units(const char* what, const VectorXd& units, Index size) {
  const bool are_powers = std::all_of(units.begin(), units.end(), [](double unit) {
    int exponent = 0;
    return std::isfinite(unit) && std::frexp(unit, &exponent) == 0.5;
  });
  if (units.size() != size || !are_powers)
    throw std::invalid_argument(std::string("SystemInUnits::SystemInUnits: the units of the ") +
                                what + " are " + std::to_string(units.size()) +
                                " numbers; expected " + std::to_string(size) + " powers of two.");
}

// That what M has no unit for is a number, and that what has one unit has it.
void check_scaling_symmetry(const Manifold& M, const Units& units) {
  const Manifold::ScalingSymmetries scaling = M.scaling_symmetries();
  VectorXd unit = VectorXd::Zero(Manifold::ScalingSymmetries::after(scaling.point));
  const auto fit = [&](const std::vector<Index>& numbers, const VectorXd& sizes) {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const double size = sizes[static_cast<Index>(i)];
      double number = 1.0;
      if (numbers[i] != Manifold::ScalingSymmetries::none) {
        if (unit[numbers[i]] == 0.0) unit[numbers[i]] = size;
        number = unit[numbers[i]];
      }
      if (size != number) return false;
    }
    return true;
  };
  if (!fit(scaling.point, units.coordinates) || !fit(scaling.tangent, units.tangent))
    throw std::invalid_argument(
        "SystemInUnits::SystemInUnits: the units are not those of a scaling symmetry of " +
        M.name() + ".");
}

void check_vectors(const ImplicitSystem& system, const VectorXd& equations) {
  const Manifold& M = *system.manifold();
  const std::vector<Index> mixed = M.mixed_components();
  for (Index k = 0; k < system.tangent_blocks() * M.tangent_dimension(); ++k) {
    const Index first = k - k % M.tangent_dimension();
    const Index with = first + mixed[static_cast<std::size_t>(k - first)];
    if (equations[k] != equations[with])
      throw std::invalid_argument("SystemInUnits::SystemInUnits: the units of equations " +
                                  std::to_string(with) + " and " + std::to_string(k) +
                                  " differ; expected one unit for a vector of " + M.name() + ".");
  }
}

// Empty for what is not given.
template <class Sizes>
void multiply(const Eigen::MatrixBase<Sizes>& units, const VectorXd& values, VectorXd& result) {
  if (values.size() == 0)
    result.resize(0);
  else
    result = units.cwiseProduct(values);
}

VectorXd times(const VectorXd& units, const VectorXd& values) {
  VectorXd result;
  multiply(units, values, result);
  return result;
}

ExprVector times(const VectorXd& units, const ExprVector& values) {
  ExprVector result = values;
  for (Index i = 0; i < values.size(); ++i) result[i] = units[i] * values[i];
  return result;
}

void check_sizes(const State& state, const Units& units) {
  const auto fits = [](const VectorXd& values, const VectorXd& sizes) {
    return values.size() == 0 || values.size() == sizes.size();
  };
  if (!fits(state.x, units.coordinates) || !fits(state.v, units.tangent) ||
      !fits(state.z, units.auxiliary))
    throw std::invalid_argument("Units: the state has other sizes than the units.");
}

}  // namespace

void Units::measure(const State& state, State& measured) const {
  check_sizes(state, *this);
  measured.t = state.t / time;
  multiply(coordinates.cwiseInverse(), state.x, measured.x);
  multiply(time * tangent.cwiseInverse(), state.v, measured.v);
  multiply(auxiliary.cwiseInverse(), state.z, measured.z);
}

void Units::restore(const State& measured, State& state) const {
  check_sizes(measured, *this);
  state.t = time * measured.t;
  multiply(coordinates, measured.x, state.x);
  multiply(tangent / time, measured.v, state.v);
  multiply(auxiliary, measured.z, state.z);
}

State Units::measure(const State& state) const {
  State measured{.carried = state.carried};
  measure(state, measured);
  return measured;
}

State Units::restore(const State& measured) const {
  State state{.carried = measured.carried};
  restore(measured, state);
  return state;
}

VectorXd chart_units(const Units& units, const Manifold& M, const VectorXd& x) {
  const MatrixXd basis = M.tangent_basis(x).matrix();
  VectorXd result(basis.cols());
  for (Index j = 0; j < basis.cols(); ++j) {
    Index largest = 0;
    basis.col(j).cwiseAbs().maxCoeff(&largest);
    result[j] = units.tangent[largest];
  }
  return result;
}

SystemInUnits::SystemInUnits(std::shared_ptr<const ImplicitSystem> system, Units units)
    : ImplicitSystem(system ? system->manifold() : nullptr, system ? system->auxiliary_size() : 0,
                     system ? system->equation_count() : 0, system ? system->names() : Names{}),
      system_(std::move(system)),
      units_(std::move(units)) {
  check_units("coordinates", units_.coordinates, manifold()->ambient_dimension());
  check_units("tangent vectors", units_.tangent, manifold()->tangent_dimension());
  check_scaling_symmetry(*manifold(), units_);
  check_units("auxiliary unknowns", units_.auxiliary, auxiliary_size());
  check_units("equations", units_.equations, equation_count());
  check_units("time", VectorXd::Constant(1, units_.time), 1);
  check_vectors(*this, units_.equations);
}

ExprVector SystemInUnits::do_residual(const ExprVector& x, const ExprVector& v, const ExprVector& z,
                                      const Expr& t) const {
  return times(
      units_.equations.cwiseInverse(),
      system_->residual(times(units_.coordinates, x), times(units_.tangent / units_.time, v),
                        times(units_.auxiliary, z), units_.time * t));
}

std::optional<Expr> SystemInUnits::do_energy(const ExprVector& x, const ExprVector& z,
                                             const Expr& t) const {
  return system_->energy(times(units_.coordinates, x), times(units_.auxiliary, z), units_.time * t);
}

VectorXd SystemInUnits::do_auxiliary_guess(const VectorXd& x, const VectorXd& v) const {
  return system_
      ->auxiliary_guess(times(units_.coordinates, x), times(units_.tangent / units_.time, v))
      .cwiseQuotient(units_.auxiliary);
}

}  // namespace courant
