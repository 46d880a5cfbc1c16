#include "courant/integrators/ladder/constraint_algorithm.hpp"

#include <algorithm>
#include <cmath>

#include "courant/integrators/ladder/consistent_point.hpp"
#include "courant/integrators/ladder/ladder_levels.hpp"

namespace courant {
namespace {

bool repeats(const std::vector<LadderLevel>& levels) {
  if (levels.size() < 2) return false;
  const LadderLevel& last = levels.back();
  const LadderLevel& before = levels[levels.size() - 2];
  return last.dim_S == before.dim_S && last.dim_M == before.dim_M;
}

// Where dimensions differ at a point and at one nearby, in words; empty if they do not. A rank can
// only be higher nearby: where it seems lower a number was taken for noise, and nothing is
// concluded.
std::string difference(const std::vector<LadderLevel>& a, const std::vector<LadderLevel>& b) {
  const auto seems_lower = [](const RankDecision& here, const RankDecision& nearby) {
    return nearby.rank < here.rank;
  };
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) {
    if (a[k].is_empty || (a[k].dim_S == b[k].dim_S && a[k].dim_M == b[k].dim_M)) continue;
    if (seems_lower(a[k].all, b[k].all) ||
        seems_lower(a[k].without_tangent, b[k].without_tangent) ||
        seems_lower(a[k].without_point, b[k].without_point))
      continue;
    const std::string level = std::to_string(k);
    return "(dim S_" + level + ", dim M_" + level + ") is (" + std::to_string(a[k].dim_S) + ", " +
           std::to_string(a[k].dim_M) + ") here and (" + std::to_string(b[k].dim_S) + ", " +
           std::to_string(b[k].dim_M) + ") at a consistent point nearby.";
  }
  return "";
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

std::vector<LadderLevel> levels_at(const ConsistentJet& jet, double data_error) {
  return ladder_levels(jet.array, jet.zero.y, jet.zero.reach,
                       data_error + 10.0 * jet.zero.uncertainty);
}

// What is singular at a zero of the derivative array, as seen from one point nearby, in words;
// empty if nothing is. Zeros of constant rank form a manifold whose tangent space is the kernel of
// the Jacobian: a point at ε in a tangent direction has a zero within O(ε²), and the same ranks
// there.
std::string singularity_seen_along(const VectorXd& tangent, const TangentDisplacement& units,
                                   const ConsistentPoint& consistent, const ConsistentJet& at,
                                   const std::vector<LadderLevel>& levels, double data_error,
                                   bool follow) {
  const auto near = consistent.find_displaced(at, 1e-3 * tangent);
  if (!near.jet.zero.found) return "";
  const std::string other = difference(levels, levels_at(near.jet, data_error));
  if (!other.empty()) return other;
  // Sparse factors know the kernel to five digits only: too few for what follows.
  if (!follow || tangent.size() > 200) return "";
  // How far the zeros are from ε·tangent: quadratic in ε if regular, linear if not. Round-off is
  // 10⁻⁶; a curvature of 10⁴ makes the first ratio look linear, but not the second.
  const auto off = [&](double epsilon) {
    const auto found = consistent.find_displaced(at, epsilon * tangent);
    return found.jet.zero.found ? units.size(found.correction) : 0.0;
  };
  const double off3 = units.size(near.correction), off4 = off(1e-4);
  if (off4 < 1e-5 || off4 < 0.03 * off3) return "";
  const double off5 = off(1e-5);
  const double size = units.size(tangent);
  if (!(off5 > 1e-6 && off5 > 0.05 * off4) && !(off4 > 1e-4 * size && off5 > 5e-7 * size))
    return "";
  return "The equations have solutions in fewer directions than their linear parts: one of the "
         "constraints has a vanishing gradient here.";
}

// A neighbour can be misjudged where equations are strongly curved in its direction; a singular
// point looks singular from everywhere. So the majority of three decides. Ranks are compared; with
// `follow`, zeros are followed too.
std::string singularity(const ConsistentPoint& consistent, const ConsistentJet& at,
                        const std::vector<LadderLevel>& levels, double data_error, bool follow) {
  if (at.array.has_constant_jacobian()) return "";
  TangentDisplacement tangents(at.array, at.zero.y, at.zero.reach);
  int clean = 0;
  std::string first;
  for (int i = 0; i < 3 && clean < 2; ++i) {
    const std::string finding = singularity_seen_along(tangents.next(), tangents, consistent, at,
                                                       levels, data_error, follow);
    if (finding.empty()) {
      ++clean;
      continue;
    }
    if (!first.empty()) return first;
    first = finding;
  }
  return "";
}

// Counts what other points of the final constraint set need as well: a multiplier that is zero at
// this point, as x₁ of a rod in the plane x₁ = 0, is not along a motion that leaves it.
void count_differentiations_nearby(ConstraintLadder& ladder, const ConsistentPoint& consistent,
                                   const ConsistentJet& at) {
  if (at.array.has_constant_jacobian()) return;
  TangentDisplacement tangents(at.array, at.zero.y, at.zero.reach);
  for (int i = 0; i < 2; ++i) {
    const auto near = consistent.find_displaced(at, 1e-2 * tangents.next());
    if (!near.jet.zero.found) continue;
    const std::vector<int> counts =
        needed_differentiations(near.jet.array, near.jet.zero.y, near.jet.zero.reach, ladder.index);
    for (std::size_t e = 0; e < counts.size(); ++e)
      ladder.differentiations[e] = std::max(ladder.differentiations[e], counts[e]);
  }
}

}  // namespace

ConstraintLadder ConstraintAlgorithm::run(const std::shared_ptr<const ImplicitSystem>& system,
                                          const InitialGuess& guess) const {
  const ConsistentPoint consistent(system, guess, options_.metric);
  ConsistentJet jet = consistent.start();
  ConstraintLadder ladder;
  bool stopped = false;
  std::string singular;
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
    ladder.levels = levels_at(jet, options_.data_error);
    stopped = repeats(ladder.levels);
    singular = singularity(consistent, jet, ladder.levels, options_.data_error, stopped);
    if (!singular.empty()) break;
  }
  ladder.point = jet.array.state(jet.zero.y);
  ladder.jet = jet.zero.y;
  ladder.moved = consistent.distance(ladder.point.x);
  ladder.moves = movements(*system, guess, ladder.point);
  if (!singular.empty()) {
    ladder.verdict = Verdict::rank_change;
    ladder.reason = singular;
  }
  if (ladder.levels.back().is_empty) return ladder;

  const LadderLevel& last = ladder.levels.back();
  ladder.degrees_of_freedom = last.dim_M;
  ladder.gauge_dimension = last.fibre();
  if (ladder.verdict == Verdict::rank_change) return ladder;
  if (!stopped) {
    ladder.reason =
        "The dimensions still fell at level " + std::to_string(last.k) + ", the highest allowed.";
    return ladder;
  }
  ladder.index = last.k - 1;
  ladder.verdict = ladder.gauge_dimension == 0 ? Verdict::regular : Verdict::gauge;
  describe(ladder, jet.array, jet.zero.y, jet.zero.reach);
  count_differentiations_nearby(ladder, consistent, jet);
  return ladder;
}

}  // namespace courant
