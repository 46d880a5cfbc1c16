#include "courant/integrators/constraint_algorithm.hpp"

#include <cmath>
#include <random>

#include "courant/integrators/consistent_point.hpp"
#include "courant/integrators/ladder_levels.hpp"

namespace courant {
namespace {

bool repeats(const std::vector<LadderLevel>& levels) {
  if (levels.size() < 2) return false;
  const LadderLevel& last = levels.back();
  const LadderLevel& before = levels[levels.size() - 2];
  return last.dim_S == before.dim_S && last.dim_M == before.dim_M;
}

bool same_dimensions(const std::vector<LadderLevel>& a, const std::vector<LadderLevel>& b) {
  for (std::size_t k = 0; k < a.size(); ++k)
    if (a[k].dim_S != b[k].dim_S || a[k].dim_M != b[k].dim_M) return false;
  return true;
}

std::string derivative_of(const std::string& name, Index order) {
  if (order == 0) return name;
  if (order == 1) return "d/dt " + name;
  return "d^" + std::to_string(order) + "/dt^" + std::to_string(order) + " " + name;
}

// The equations that contradict each other at a point where Jᵀ F = 0: those that F, a left null
// vector, consists of.
std::string contradiction(const ImplicitSystem& system, const Zero& zero) {
  const Index r = system.equation_count();
  const double largest =
      zero.scaled_value.size() == 0 ? 0.0 : zero.scaled_value.lpNorm<Eigen::Infinity>();
  std::string names;
  int listed = 0;
  for (Index i = 0; i < zero.scaled_value.size(); ++i) {
    if (std::abs(zero.scaled_value[i]) < 0.1 * largest) continue;
    if (++listed > 6) return names + ", …";
    names += names.empty() ? "" : ", ";
    names += i < 0
                 ? ""
                 : derivative_of(system.names().equations[static_cast<std::size_t>(i % r)], i / r);
  }
  return names;
}

std::vector<Movement> movements(const ImplicitSystem& system, const InitialGuess& guess,
                                const State& point) {
  std::vector<Movement> moves;
  const auto compare = [&](const VectorXd& given, const VectorXd& found, const auto& name) {
    const double size = given.size() == 0 ? 0.0
                                          : std::max(given.lpNorm<Eigen::Infinity>(),
                                                     found.lpNorm<Eigen::Infinity>());
    for (Index i = 0; i < given.size(); ++i)
      if (std::abs(given[i] - found[i]) > 1e-12 * size)
        moves.push_back({name(static_cast<std::size_t>(i)), given[i], found[i]});
  };
  const ImplicitSystem::Names& names = system.names();
  compare(guess.x, point.x, [&](std::size_t i) { return names.coordinates[i]; });
  const bool one_name_each = guess.v.size() == guess.x.size();
  compare(guess.v, point.v, [&](std::size_t i) {
    return one_name_each ? names.coordinates[i] + "'" : "v[" + std::to_string(i) + "]";
  });
  compare(guess.z, point.z, [&](std::size_t i) { return names.auxiliary[i]; });
  return moves;
}

}  // namespace

ConstraintLadder ConstraintAlgorithm::run(const std::shared_ptr<const ImplicitSystem>& system,
                                          const InitialGuess& guess) const {
  const ConsistentPoint consistent(system, guess, options_.metric);
  ConsistentJet jet = consistent.start();
  ConstraintLadder ladder;
  bool stopped = false;
  for (Index k = 0; k <= options_.max_level && !stopped; ++k) {
    jet.zero.y = jet.array.resized(jet.zero.y, k);
    const ConsistentJet next = consistent.find(jet);
    if (!next.zero.found) {
      LadderLevel empty;
      empty.k = k;
      empty.is_empty = true;
      empty.residual = next.array.residual(next.zero.y).lpNorm<Eigen::Infinity>();
      ladder.levels.push_back(empty);
      ladder.verdict = Verdict::inconsistent;
      ladder.reason = "No point of S_" + std::to_string(k) +
                      " was found near the given values: these equations contradict each other: " +
                      contradiction(*system, next.zero) + ".";
      jet.zero.y = next.array.resized(next.zero.y, k);
      break;
    }
    jet = next;
    ladder.levels = ladder_levels(
        jet.array, jet.zero.y, {.data_error = options_.data_error + 10.0 * jet.zero.uncertainty});
    stopped = repeats(ladder.levels);
  }
  ladder.point = jet.array.state(jet.zero.y);
  ladder.jet = jet.zero.y;
  ladder.moved = consistent.distance(ladder.point.x);
  ladder.moves = movements(*system, guess, ladder.point);
  if (ladder.verdict == Verdict::inconsistent) return ladder;

  const LadderLevel& last = ladder.levels.back();
  ladder.degrees_of_freedom = last.dim_M;
  ladder.gauge_dimension = last.fibre();
  if (!stopped) {
    ladder.reason =
        "The dimensions still fell at level " + std::to_string(last.k) + ", the highest allowed.";
    return ladder;
  }
  ladder.index = last.k - 1;
  ladder.verdict = ladder.gauge_dimension == 0 ? Verdict::regular : Verdict::gauge;
  describe(ladder, jet.array, jet.zero.y);

  if (jet.array.has_constant_jacobian()) return ladder;
  std::mt19937 generator(options_.seed);
  for (int i = 0; i < options_.neighbours; ++i) {
    const ConsistentJet near =
        consistent.find_displaced(jet, small_displacement(jet.array, jet.zero.y, generator));
    if (!near.zero.found) continue;
    const auto there =
        ladder_levels(near.array, near.zero.y,
                      {.data_error = options_.data_error + 10.0 * near.zero.uncertainty});
    if (!same_dimensions(ladder.levels, there)) {
      ladder.verdict = Verdict::rank_change;
      ladder.reason = "At a consistent point nearby the dimensions are others.";
      break;
    }
  }
  return ladder;
}

}  // namespace courant
