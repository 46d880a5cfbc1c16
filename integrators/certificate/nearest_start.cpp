#include "courant/integrators/certificate/nearest_start.hpp"

#include <algorithm>
#include <random>
#include <stdexcept>

namespace courant {
namespace {

State state_of_jet(const ConsistentJet& jet) { return jet.array().state(jet.zero().y); }

// The given point moved by `distance` in the metric of a change that is one of points: a direction of random numbers.
VectorXd displaced_by(const VectorXd& x, const LeastChange& change, double distance,
                      std::mt19937& generator) {
  std::normal_distribution<double> normal;
  VectorXd direction(change.root.cols());
  for (double& entry : direction) entry = normal(generator);
  const double length = (change.root * direction).norm();
  VectorXd there = x;
  if (length > 0.0)
    for (std::size_t i = 0; i < change.rows.size(); ++i)
      there[change.rows[i]] += distance / length * direction[static_cast<Index>(i)];
  return there;
}

// The best of zeros that are begun from at the given point, as it moves and at rest, and at `around` points as far from
// it as the nearest that is known. One that is nearer by rounding is not: at rest units are round-off, and a search for
// momenta from there finds none.
ConsistentPoint::Least best_of(const ConsistentPoint& consistent, const InitialGuess& given,
                               const LeastChange& change, int around, ConsistentPoint::Least best) {
  constexpr double less = 1.0 - 1e-9, round_off = 1e-13;
  const double rounding = round_off * (change.root * change.given).norm();
  const auto include = [&](const VectorXd& x, const VectorXd& v) {
    try {
      const ConsistentJet start = consistent.find_from(x, v, VectorXd(), best.jet);
      if (!start.zero().found || !consistent.is_met_at(start)) return;
      ConsistentPoint::Least other = consistent.least_changed(start, change, {});
      if (other.found.deviation < less * best.found.deviation - rounding &&
          consistent.is_met_at(other.jet))
        best = std::move(other);
    } catch (const std::domain_error&) {  // no point of the manifold is near
    }
  };
  include(given.x, given.v);
  VectorXd rest = VectorXd::Zero(given.x.size());
  for (const Index row : change.rows) rest[row] = given.x[row];
  for (const Index row : given.hold_x) rest[row] = given.x[row];
  include(rest, VectorXd());
  std::mt19937 generator(20261127);
  const double distance = best.found.deviation;
  for (int guess = 0; guess < around; ++guess)
    include(displaced_by(rest, change, distance, generator), VectorXd());
  return best;
}

}  // namespace

NearestStart::NearestStart(const std::shared_ptr<const ChartEquations>& equations,
                           const InitialGuess& guess, const ConstraintLadder& from,
                           const std::vector<Stage>& stages) {
  if (from.levels.empty() || from.levels.back().is_empty)
    throw std::invalid_argument(
        "NearestStart::NearestStart: the ladder has no point, expected one that has.");
  const ConsistentPoint consistent(equations, guess, {});
  const Index N = equations->system()->manifold()->ambient_dimension();
  ConsistentJet jet = consistent.jet_of(from);
  if (!consistent.is_met_at(jet)) {
    const State far = state_of_jet(jet);
    jet = consistent.find_from(far.x, far.v, far.z, jet);
  }
  ConsistentPoint::Values kept;
  for (const Stage& stage : stages) {
    const LeastChange change = stage(state_of_jet(jet));
    if (change.rows.empty()) continue;
    ConsistentPoint::Least least = consistent.least_changed(jet, change, kept);
    // Far away there may be nearer points elsewhere, and where second derivatives along the zeros are far from those of
    // a plane.
    constexpr double flat = 0.5, far = 1e-2;
    constexpr int guesses = 12;
    constexpr Index most_unknowns = 200;
    const bool is_of_points =
        std::all_of(change.rows.begin(), change.rows.end(), [&](Index row) { return row < N; });
    if (kept.empty() && is_of_points && jet.zero().y.size() <= most_unknowns) {
      const bool is_alone = least.found.curvature >= flat && least.found.is_stationary() &&
                            least.found.deviation < far * (change.root * change.given).norm();
      least = best_of(consistent, guess, change, is_alone ? 0 : guesses, std::move(least));
    }
    jet = std::move(least.jet);
    outcomes_.push_back({.distance = least.found.deviation,
                         .slope = least.found.slope,
                         .is_stationary = least.found.is_stationary()});
    is_proven_ = is_proven_ && least.found.is_stationary();
    const VectorXd found = numbers_of(state_of_jet(jet));
    for (const Index row : change.rows) kept.emplace_back(row, found[row]);
  }
  is_consistent_ = consistent.is_met_at(jet);
  point_ = state_of_jet(jet);
  const auto keep = [](VectorXd& found, const VectorXd& given, const std::vector<Index>& held) {
    for (const Index i : held) found[i] = given[i];
  };
  keep(point_.x, guess.x, guess.hold_x);
  keep(point_.v, guess.v, guess.hold_v);
  keep(point_.z, guess.z, guess.hold_z);
}

}  // namespace courant
