#include "courant/integrators/certificate/consistent_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/integrators/certificate/ladder_levels.hpp"
#include "courant/integrators/certificate/natural_scaling.hpp"

namespace courant {
namespace {

void check_size(const char* argument, Index size, Index expected, bool may_be_empty) {
  if (size != expected && !(may_be_empty && size == 0))
    throw std::invalid_argument(std::string("ConstraintAlgorithm::run: ") + argument + " has " +
                                std::to_string(size) + " entries, expected " +
                                std::to_string(expected) + ".");
}

void check_finite(const char* argument, const VectorXd& values) {
  for (Index i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]))
      throw std::invalid_argument(std::string("ConstraintAlgorithm::run: entry ") +
                                  std::to_string(i) + " of " + argument +
                                  " is not a finite number.");
}

// A zero that is one by the sizes that numbers have there. Those that were met on the way, as after a
// first step of 10⁸, are no sizes of the problem, and next to them residuals of 1 are round-off. Among
// exponentials each search may go astray so, and its zero has to be one by its terms too.
Zero find_confirmed(const LinearizableMap& map, const VectorXd& start, const Mobility& mobility) {
  constexpr double accepted = 1e-10;
  Zero zero = find_zero(map, start, mobility);
  for (int look = 0; look < 5 && zero.found && zero.iterations > 0; ++look) {
    Zero again = find_zero(map, zero.y, mobility);
    if (again.history.front() <= accepted) break;
    zero = std::move(again);
  }
  if (mobility.has_exponentials && zero.found && !is_met(map(zero.y))) zero.found = false;
  return zero;
}

Deviation change_at(const LeastChange& change, const DerivativeArray& array, const VectorXd& y) {
  const Linearization state = array.state_map(y);
  const Eigen::SparseMatrix<double, Eigen::RowMajor> by_row = state.jacobian;
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t i = 0; i < change.rows.size(); ++i)
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(by_row, change.rows[i]); it;
         ++it)
      entries.emplace_back(static_cast<int>(i), static_cast<int>(it.col()), it.value());
  SparseMatrixXd rows(std::ssize(change.rows), state.jacobian.cols());
  rows.setFromTriplets(entries.begin(), entries.end());
  const VectorXd there = state.value(change.rows);
  return {change.root * (there - change.given), change.root * rows,
          (change.root * change.given).norm() + (change.root * there).norm()};
}

// Whether no F_i changes by more than its terms do to first order; one without any may change.
bool changes_by_its_terms(const LinearizableMap& F, const VectorXd& from, const VectorXd& to) {
  const Linearization at = F(from), there = F(to);
  if (!is_finite(at)) return true;
  if (!is_finite(there)) return false;
  const VectorXd terms = at.jacobian.cwiseAbs() * (to - from).cwiseAbs();
  const auto change = (there.value - at.value).array().abs();
  return (change <= terms.array() || terms.array() == 0.0).all();
}

// The largest number of each part (ξ_0, ξ_1, z_0, ξ_2, …) of a jet, for every entry of it.
VectorXd sizes_of_parts(const ConsistentJet& jet, Index unknowns) {
  const Index n = jet.array().base_size();
  VectorXd sizes = jet.zero().y.cwiseAbs();
  sizes.head(n) += jet.array().origin_size();
  const auto level = [&](Index first, Index size) {
    if (size > 0) sizes.segment(first, size).setConstant(sizes.segment(first, size).maxCoeff());
  };
  level(0, n);
  for (Index first = n; first < sizes.size(); first += n + unknowns) {
    level(first, n);
    level(first + n, unknowns);
  }
  return sizes;
}

}  // namespace

VectorXd numbers_of(const State& state) {
  VectorXd all(state.x.size() + state.v.size() + state.z.size());
  all << state.x, state.v, state.z;
  return all;
}

double LeastChange::of(const State& state) const {
  return (root * (numbers_of(state)(rows) - given)).norm();
}

ConsistentPoint::ConsistentPoint(const std::shared_ptr<const ChartEquations>& equations,
                                 InitialGuess guess, SparseMatrixXd metric)
    : system_(equations->system()), guess_(std::move(guess)), metric_(std::move(metric)) {
  const Index N = system_->manifold()->ambient_dimension();
  const Index tangent = system_->manifold()->tangent_dimension();
  check_size("x", guess_.x.size(), N, false);
  check_size("v", guess_.v.size(), tangent, true);
  check_size("z", guess_.z.size(), system_->auxiliary_size(), true);
  check_size("metric", metric_.size(), N * N, true);
  check_finite("x", guess_.x);
  check_finite("v", guess_.v);
  check_finite("z", guess_.z);
  check_finite("t", VectorXd::Constant(1, guess_.t));
  const auto M = system_->manifold();
  array_.emplace(equations, guess_.t,
                 M->point_defect(guess_.x) == 0.0 ? guess_.x : M->project(guess_.x));
  if (M->dimension() == N) drop_round_off();
  const auto hold = [&](const std::vector<Index>& components, const VectorXd& values, Index offset,
                        const char* name) {
    for (const Index i : components) {
      if (i < 0 || i >= values.size())
        throw std::invalid_argument(std::string("ConstraintAlgorithm::run: component ") +
                                    std::to_string(i) + " of " + name + " is to be held, but " +
                                    name + " has " + std::to_string(values.size()) +
                                    " given entries.");
      held_.emplace_back(offset + i, values[i]);
    }
  };
  hold(guess_.hold_x, guess_.x, 0, "x");
  hold(guess_.hold_v, guess_.v, N, "v");
  hold(guess_.hold_z, guess_.z, N + tangent, "z");
  z_is_given_ = guess_.z.size() > 0;
  if (!z_is_given_) guess_.z = system_->auxiliary_guess(guess_.x, guess_.v);
}

// A user who computes cos(π/2) means 0; equations that hold at a point with zeros would hold nowhere
// near it otherwise.
void ConsistentPoint::drop_round_off() {
  constexpr double round_off = 8.0 * std::numeric_limits<double>::epsilon();
  const Index n = array_->base_size();
  const VectorXd y = array_->jet(guess_.v, guess_.z);
  VectorXd nominal = y.cwiseAbs();
  nominal.head(n) = array_->origin_size();
  Linearization at = array_->linearize(y);
  if (!is_finite(at)) return;
  const SparseMatrixXd magnitude = generic_magnitude(
      [&](const VectorXd& there) { return array_->linearize(there); }, y, nominal, at);
  at.value.setZero();
  // Where all numbers are small the largest is a unit, so that it stays.
  const NaturalScaling units({at.value, magnitude}, nominal, 0.0);
  // Round-off is small next to other numbers too. Units alone do not tell: those of a circuit whose
  // currents grow like exp (v/25 mV) may be 10¹⁶ of what flows.
  const double given = nominal.size() == 0 ? 0.0 : nominal.maxCoeff();
  const auto drop = [&](VectorXd& values, Index first) {
    for (Index i = 0; i < values.size(); ++i)
      if (std::fabs(values[i]) <= round_off * std::min(units.column_scale[first + i], given))
        values[i] = 0.0;
  };
  drop(guess_.x, 0);
  drop(guess_.v, n);
  drop(guess_.z, 2 * n);
  array_ = array_->at(guess_.t, guess_.x);
}

ConsistentJet::ConsistentJet(DerivativeArray array, Zero zero)
    : array_(std::move(array)), zero_(std::move(zero)) {
  level_ = array_.level_of(zero_.y);
  if (zero_.nominal.size() != zero_.y.size() || zero_.uncertainty.size() != zero_.y.size())
    throw std::invalid_argument(
        "ConsistentJet::ConsistentJet: y, nominal and uncertainty have " +
        std::to_string(zero_.y.size()) + ", " + std::to_string(zero_.nominal.size()) + " and " +
        std::to_string(zero_.uncertainty.size()) + " entries, expected as many of each.");
}

ConsistentJet ConsistentJet::at_level(Index k) const {
  Zero there = zero_;
  for (VectorXd* numbers : {&there.y, &there.nominal, &there.uncertainty})
    *numbers = array_.resized(*numbers, k);
  return {array_, std::move(there)};
}

ConsistentJet ConsistentPoint::start() const {
  return {*array_, Zero(array_->jet(guess_.v, guess_.z))};
}

LinearizableMap ConsistentPoint::conditions(const DerivativeArray& array, const Values& held) {
  return [&array, held](const VectorXd& y) {
    Linearization at = array.linearize(y);
    if (!held.empty()) {
      const Linearization state = array.state_map(y);
      const Eigen::SparseMatrix<double, Eigen::RowMajor> by_row = state.jacobian;
      std::vector<Eigen::Triplet<double>> entries;
      for (Index j = 0; j < at.jacobian.outerSize(); ++j)
        for (SparseMatrixXd::InnerIterator it(at.jacobian, j); it; ++it)
          entries.emplace_back(static_cast<int>(it.row()), static_cast<int>(j), it.value());
      Index row = at.value.size();
      at.value.conservativeResize(row + std::ssize(held));
      at.value_error.conservativeResize(at.value.size());
      for (const auto& [component, value] : held) {
        at.value[row] = state.value[component] - value;
        at.value_error[row] = 4.0 * Uncertain::unit * std::fabs(value);
        for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(by_row, component); it;
             ++it)
          entries.emplace_back(static_cast<int>(row), static_cast<int>(it.col()), it.value());
        ++row;
      }
      at.error.conservativeResize(row, y.size());  // what is held is known
      at.jacobian.resize(row, y.size());
      at.jacobian.setFromTriplets(entries.begin(), entries.end());
    }
    return at;
  };
}

Mobility ConsistentPoint::mobility(const ConsistentJet& from, bool x_is_free) const {
  const Index n = from.array().base_size(), size = from.zero().y.size();
  Mobility result;
  result.frozen = x_is_free ? 0 : n;
  result.has_exponentials = from.array().has_exponentials();
  // Where x or a velocity can give way, the velocity does: by a factor of 1000 in the squares.
  result.cost = VectorXd::Constant(size, 0.03);
  result.cost.head(n).setOnes();
  // Where an unknown that is given and a velocity that is not can give way, the velocity does: z of
  // the guess chooses between branches.
  if (z_is_given_ && guess_.v.size() == 0)
    result.cost.segment(2 * n, guess_.z.size()).setConstant(0.3);
  result.nominal = from.array().resized(from.zero().nominal, from.array().level_of(from.zero().y));
  result.offset = from.array().origin_size();
  result.nominal.head(n) = result.nominal.head(n).cwiseMax(result.offset);
  if (x_is_free)
    result.admits = [extent = system_->manifold()->extent_at(from.array().origin()),
                     basis = from.array().basis()](const VectorXd& y) {
      return extent(basis * y.head(basis.cols())) < 0.9;
    };
  const double radius = system_->manifold()->injectivity_radius(from.array().origin());
  if (std::isfinite(radius))  // angles
    result.nominal.head(n) = result.nominal.head(n).cwiseMax(radius / std::numbers::pi);
  return result;
}

Quadratic ConsistentPoint::displacement(const DerivativeArray& array, const VectorXd& y) const {
  const Index N = system_->manifold()->ambient_dimension(), n = array.base_size();
  const Linearization state = array.state_map(y);
  const VectorXd moved = state.value.head(N) - guess_.x;
  const SparseMatrixXd d_x = state.jacobian.topLeftCorner(N, n);
  if (metric_.size() == 0)
    return {0.5 * moved.squaredNorm(), d_x.transpose() * moved,
            SparseMatrixXd(d_x.transpose() * d_x)};
  const VectorXd force = metric_ * moved;
  return {0.5 * moved.dot(force), d_x.transpose() * force,
          SparseMatrixXd(d_x.transpose() * metric_ * d_x)};
}

double ConsistentPoint::distance(const VectorXd& x) const {
  const VectorXd moved = x - guess_.x;
  if (metric_.size() == 0) return moved.norm();
  return std::sqrt(std::max(0.0, moved.dot(VectorXd(metric_ * moved))));
}

ConsistentJet ConsistentPoint::recentred(const DerivativeArray& array, const Zero& zero,
                                         const Values& held) const {
  const State state = array.state(zero.y);
  const DerivativeArray at_point = array.at(array.t(), state.x);
  Zero there = zero;
  const VectorXd first = at_point.jet(state.v, state.z);
  there.y.head(first.size()) = first;
  // ξ_0 = 0 and ξ_1, z_0 are those of the same state; higher coefficients change with the chart.
  Zero polished = find_zero(conditions(at_point, held), there.y,
                            mobility(ConsistentJet(at_point, there), false));
  if (!polished.found) return {at_point, std::move(there)};
  polished.iterations += zero.iterations;
  // The origin of the chart is no better known than where it was found.
  const Index n = array.base_size();
  polished.uncertainty.head(n) = polished.uncertainty.head(n).cwiseMax(zero.uncertainty.head(n));
  return {at_point, std::move(polished)};
}

std::optional<ConsistentJet> ConsistentPoint::find_beyond(const ConsistentJet& ended) const {
  constexpr int most_charts = 20;
  constexpr double outside = 0.5;  // of the domain of a chart; searches end at 0.9 of it
  ConsistentJet at = ended;
  const Index n = at.array().base_size();
  for (int chart = 0; chart < most_charts; ++chart) {
    const auto extent = system_->manifold()->extent_at(at.array().origin());
    if (at.zero().found || !at.zero().is_finite ||
        !(extent(at.array().basis() * at.zero().y.head(n)) > outside))
      return std::nullopt;
    const State state = at.array().state(at.zero().y);
    const DerivativeArray there = at.array().at(at.array().t(), state.x);
    Zero zero = at.zero();
    const VectorXd first = there.jet(state.v, state.z);
    zero.y.head(first.size()) = first;
    const LinearizableMap F = conditions(there, held_);
    const Mobility free = mobility(ConsistentJet(there, zero), true);
    zero = find_confirmed(F, zero.y, free);
    at = ConsistentJet(there, zero);
    if (!zero.found) continue;
    return recentred(there,
                     least_zero(
                         F, [&](const VectorXd& y) { return displacement(there, y); }, zero, free),
                     held_);
  }
  return std::nullopt;
}

ConsistentJet ConsistentPoint::find(const ConsistentJet& from) const {
  const LinearizableMap F = conditions(from.array(), held_);
  const Index n = from.array().base_size();
  const bool has_exponentials = from.array().has_exponentials();
  if (has_exponentials)
    if (const auto above = find_above(from, F)) return {from.array(), *above};
  Zero zero = find_zero(F, from.zero().y, mobility(from, false));
  if (zero.found && !(has_exponentials && !is_met(F(zero.y)))) return {from.array(), zero};
  if (const auto start = from.array().beyond_exponentials(from.zero().y))
    if (const Zero other = find_zero(F, *start, mobility(from, false));
        other.found && is_met(F(other.y)))
      return {from.array(), other};
  if (zero.found) return {from.array(), zero};
  const Mobility free = mobility(from, true);
  zero = find_confirmed(F, from.zero().y, free);
  if (const auto far = find_beyond({from.array(), zero}); far) return *far;
  // At a point where equations have no linear part, as x² + y² = 1 at 0, no step leads anywhere.
  if (!zero.found && zero.is_finite) {
    TangentDisplacement displacements(from.array(), from.zero().y,
                                      free.nominal.cwiseMax(from.zero().y.cwiseAbs()));
    for (const double size : {0.1, 0.3, 1.0, 1e2, 1e4, 1e6, 1e8}) {
      VectorXd displacement = displacements.next();
      displacement.head(n) *= size;
      displacement.tail(displacement.size() - n) *= std::min(size, 1.0);
      const Zero other = find_confirmed(F, from.zero().y + displacement, free);
      if (other.found || (other.is_finite && !is_contradiction({from.array(), other})))
        zero = other;
      if (zero.found) break;
    }
  }
  if (!zero.found) return {from.array(), zero};
  zero = least_zero(
      F, [&](const VectorXd& y) { return displacement(from.array(), y); }, zero, free);
  return recentred(from.array(), zero, held_);
}

// The equations of a level are linear in its own unknowns. Where these, or these and those of the levels before, solve
// them, no lower ones have to move: on the way to such a zero the voltage of a diode may move by volts, which is far for
// exp (v/25 mV).
std::optional<Zero> ConsistentPoint::find_above(const ConsistentJet& from,
                                                const LinearizableMap& F) const {
  for (Index level = from.level() - 1; level >= 0; --level) {
    Mobility above = mobility(from, false);
    above.frozen = from.array().unknown_count(level);
    // Linear equations have the same derivatives everywhere.
    if (level == from.level() - 1) above.magnitude = F(from.zero().y).jacobian.cwiseAbs();
    Zero zero = find_zero(F, from.zero().y, above);
    if (!zero.found || !is_met(F(zero.y))) continue;
    zero.uncertainty.head(above.frozen) =
        zero.uncertainty.head(above.frozen).cwiseMax(from.zero().uncertainty.head(above.frozen));
    return zero;
  }
  return std::nullopt;
}

bool ConsistentPoint::is_contradiction(const ConsistentJet& jet) const {
  const Linearization at = conditions(jet.array(), held_)(jet.zero().y);
  UncertainMatrix J{at.jacobian, at.error}, with_F = J;
  for (SparseMatrixXd* matrix : {&with_F.value, &with_F.error})
    matrix->conservativeResize(matrix->rows(), matrix->cols() + 1);
  for (Index i = 0; i < at.value.size(); ++i) {
    const bool is_zero = std::fabs(at.value[i]) <= at.value_error[i];
    if (!is_zero) with_F.value.insert(i, J.cols()) = at.value[i];
    with_F.error.insert(i, J.cols()) = at.value_error[i] + (is_zero ? std::fabs(at.value[i]) : 0.0);
  }
  with_F.value.makeCompressed();
  with_F.error.makeCompressed();
  const RankDecision together = decide_rank(with_F);
  return together.rank > decide_rank(J).rank && !together.ambiguous();
}

ConsistentPoint::Least ConsistentPoint::least_changed(const ConsistentJet& from,
                                                      const LeastChange& change,
                                                      const Values& kept) const {
  Values held = held_;
  held.insert(held.end(), kept.begin(), kept.end());
  const DerivativeArray& array = from.array();
  LeastDeviation found = least_deviation(
      conditions(array, held), [&](const VectorXd& y) { return change_at(change, array, y); },
      from.zero(), mobility(from, true));
  return {recentred(array, found.zero, held), found};
}

ConsistentJet ConsistentPoint::find_from(const VectorXd& x, const VectorXd& v, const VectorXd& z,
                                         const ConsistentJet& like) const {
  constexpr int most_charts = 20;
  constexpr double far = 10.0;
  const auto M = system_->manifold();
  const auto search = [&](const VectorXd& x, const VectorXd& v, const VectorXd& z) {
    const DerivativeArray array =
        like.array().at(like.array().t(), M->point_defect(x) == 0.0 ? x : M->project(x));
    const ConsistentJet start = ConsistentJet(array, Zero(array.jet(v, z))).at_level(like.level());
    return ConsistentJet(
        array, find_confirmed(conditions(array, held_), start.zero().y, mobility(start, true)));
  };
  ConsistentJet jet = search(x, v, z);
  for (int chart = 1; chart < most_charts && jet.zero().is_finite; ++chart) {
    const State state = jet.array().state(jet.zero().y);
    if (!(jet.array().origin().norm() > far * state.x.norm())) break;
    jet = search(state.x, state.v, state.z);
  }
  return jet;
}

ConsistentJet ConsistentPoint::jet_of(const ConstraintLadder& ladder) const {
  Zero zero(ladder.jet);
  zero.found = true;
  return {array_->at(ladder.point.t, ladder.point.x), std::move(zero)};
}

bool ConsistentPoint::is_met_at(const ConsistentJet& jet, double unseen, double nothing) const {
  constexpr double of_exponentials =
      1e-6;  // of what grows like exp (v/25 mV) fewer digits are known
  const Linearization at = conditions(jet.array(), held_)(jet.zero().y);
  if (!jet.zero().found || at.value_error.size() != at.value.size()) return jet.zero().found;
  const double part = jet.array().has_exponentials() ? std::max(unseen, of_exponentials) : unseen;
  const VectorXd terms = at.jacobian.cwiseAbs() * sizes_of_parts(jet, system_->auxiliary_size());
  const auto F = at.value.array().abs();
  return (F <= part / Uncertain::unit * at.value_error.array() ||
          F <= nothing * (1.0 + terms.array()))
      .all();
}

ConsistentJet ConsistentPoint::again(const ConsistentJet& jet) const {
  return recentred(jet.array(), jet.zero(), held_);
}

ConsistentPoint::Neighbour ConsistentPoint::find_displaced(const ConsistentJet& from,
                                                           const VectorXd& displacement,
                                                           const SparseMatrixXd& magnitude) const {
  return find_around(from, from.array(), from.zero().y, displacement, magnitude);
}

ConsistentJet ConsistentPoint::find_at(const ConsistentJet& from, const VectorXd& xi) const {
  VectorXd y = from.zero().y;
  y.head(xi.size()) = xi;
  return {from.array(), find_zero(conditions(from.array(), {}), y, mobility(from, false))};
}

ConsistentPoint::Neighbour ConsistentPoint::find_later(const ConsistentJet& from,
                                                       const VectorXd& displacement,
                                                       double later) const {
  // Entries that contain t may vanish now and not later, so that magnitudes of now tell nothing.
  return find_around(from, from.array().at(from.array().t() + later, from.array().origin()),
                     from.array().carried(from.zero().y, later), displacement, SparseMatrixXd());
}

ConsistentPoint::Neighbour ConsistentPoint::find_around(const ConsistentJet& from,
                                                        const DerivativeArray& array,
                                                        const VectorXd& start,
                                                        const VectorXd& displacement,
                                                        const SparseMatrixXd& magnitude) const {
  Mobility free = mobility(from, true);
  const LinearizableMap F = conditions(array, {});
  VectorXd y = start + displacement;
  // Units of 10⁹ are none of angles, and volts none where exp (v/25 mV) is.
  const auto is_near = [&] {
    return (!free.admits || free.admits(y)) &&
           (!free.has_exponentials || changes_by_its_terms(F, start, y));
  };
  for (double part = 0.1; !is_near() && part > 1e-20; part *= 0.1) y = start + part * displacement;
  free.magnitude = magnitude;
  free.noise *= 1e-3;  // of displacements that are thousandths of natural units
  Zero zero = is_near() ? find_zero(F, y, free) : Zero(y);
  // Among exponentials it has to be one by its terms, as in find_confirmed.
  if (free.has_exponentials && zero.found && !is_met(F(zero.y))) zero.found = false;
  if (!zero.found) return {{array, zero}, VectorXd::Zero(y.size())};
  return {{array, zero}, zero.y - y};
}

}  // namespace courant
