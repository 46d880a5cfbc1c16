#include "courant/integrators/ladder/constraint_algorithm.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "courant/integrators/ladder/consistent_point.hpp"
#include "courant/integrators/ladder/ladder_levels.hpp"
#include "courant/integrators/ladder/natural_scaling.hpp"
#include "courant/integrators/ladder/obstruction.hpp"

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

std::vector<LadderLevel> levels_at(const ConsistentJet& jet) {
  return ladder_levels(jet.array, jet.zero.y, jet.zero.uncertainty);
}

bool are_certain(const std::vector<LadderLevel>& levels) {
  return contradictions(levels).empty() &&
         std::none_of(levels.begin(), levels.end(),
                      [](const LadderLevel& level) { return level.is_ambiguous(); });
}

// The levels at the jet. Where they are doubtful the jet is found once more, and stays what was
// found if that helps.
std::vector<LadderLevel> levels_at(const ConsistentPoint& consistent, ConsistentJet& jet) {
  std::vector<LadderLevel> levels = levels_at(jet);
  if (are_certain(levels)) return levels;
  ConsistentJet other = consistent.again(jet);
  if (!other.zero.found) return levels;
  std::vector<LadderLevel> second = levels_at(other);
  if (!are_certain(second)) return levels;
  jet = std::move(other);
  return second;
}

// S₁
std::string level_name(const std::string& letter, Index k) {
  std::string name = letter;
  for (const char digit : std::to_string(k)) {
    name += "\xE2\x82";
    name += static_cast<char>(0x80 + (digit - '0'));
  }
  return name;
}

// Which of F^[k] at y, or of its derivatives, are not finite, in words.
std::string not_finite(const ImplicitSystem& system, const DerivativeArray& array,
                       const VectorXd& y) {
  const Index r = system.equation_count();
  const Linearization at = array.linearize(y);
  std::vector<bool> is_bad(static_cast<std::size_t>(at.value.size()), false);
  for (Index i = 0; i < at.value.size(); ++i)
    is_bad[static_cast<std::size_t>(i)] = !std::isfinite(at.value[i]);
  for (Index j = 0; j < at.jacobian.outerSize(); ++j)
    for (SparseMatrixXd::InnerIterator it(at.jacobian, j); it; ++it)
      if (!std::isfinite(it.value())) is_bad[static_cast<std::size_t>(it.row())] = true;
  for (Index i = 0; i < at.value.size(); ++i) {
    if (!is_bad[static_cast<std::size_t>(i)]) continue;
    const std::string& name = system.names().equations[static_cast<std::size_t>(i % r)];
    return std::isfinite(at.value[i])
               ? "The derivatives of " + derivative_of(name, i / r) +
                     " are not finite at the given values"
               : derivative_of(name, i / r) + " is not finite at the given values";
  }
  return "The equations are not finite at the given values";
}

// What is singular at a zero of the derivative array, in words; empty if nothing is. Zeros of
// constant rank form a manifold whose tangent space is the kernel of the Jacobian: a point at ε in
// a tangent direction has a zero within O(ε²), and the same ranks there. A neighbour can be
// misjudged where equations are strongly curved in its direction; a singular point looks singular
// from everywhere. So the majority of three decides. With `follow`, what the Jacobian does not see
// of the equations is examined too.
std::string singularity(const ConsistentPoint& consistent, const ConsistentJet& at,
                        const std::vector<LadderLevel>& levels, bool follow) {
  if (at.array.has_constant_jacobian()) return "";
  constexpr Index dense_limit = 200;
  std::optional<Obstruction> obstruction;
  if (follow && at.zero.y.size() <= dense_limit)
    obstruction.emplace(at.array, at.zero.y, at.zero.uncertainty, levels.back().all.rank);
  TangentDisplacement tangents(at.array, at.zero.y, at.zero.reach);
  const auto seen_along = [&](const VectorXd& tangent) -> std::string {
    const auto near = consistent.find_displaced(at, 1e-3 * tangent, tangents.magnitude());
    if (near.jet.zero.found) {
      const std::vector<LadderLevel> there = levels_at(near.jet);
      const std::string other = are_certain(there) ? difference(levels, there) : "";
      if (!other.empty()) return other;
    }
    if (!obstruction || !obstruction->is_seen_along(tangent)) return "";
    return "The equations have solutions in fewer directions than their linear parts: one of the "
           "constraints has a vanishing gradient here.";
  };
  int clean = 0;
  std::string first;
  for (int i = 0; i < 3 && clean < 2; ++i) {
    const std::string finding = seen_along(tangents.next());
    if (finding.empty()) {
      ++clean;
      continue;
    }
    if (!first.empty()) return first;
    first = finding;
  }
  return "";
}

// Whether the entries of the Jacobian that count as zero at the jet are small next to what they are
// nearby. Those whose bounds are as large may have been lost in their errors, and ranks with them.
bool zeros_are_certain(const ConsistentJet& at) {
  constexpr double certain = 1e-3;
  const VectorXd& y = at.zero.y;
  const Linearization here =
      at.array.linearize(y, at.zero.uncertainty.cwiseMax(Prolongation::rounding(y)));
  const SparseMatrixXd nearby = GenericScaling(at.array, y, at.zero.reach).magnitude;
  for (Index j = 0; j < here.error.outerSize(); ++j)
    for (SparseMatrixXd::InnerIterator error(here.error, j); error; ++error)
      if (here.jacobian.coeff(error.row(), j) == 0.0 &&
          error.value() > certain * nearby.coeff(error.row(), j) && error.value() > 0.0)
        return false;
  return true;
}

// Counts what other points of the final constraint set need as well: a multiplier that is zero at
// this point, as x₁ of a rod in the plane x₁ = 0, is not along a motion that leaves it.
void count_differentiations_nearby(ConstraintLadder& ladder, const ConsistentPoint& consistent,
                                   const ConsistentJet& at) {
  if (at.array.has_constant_jacobian()) return;
  TangentDisplacement tangents(at.array, at.zero.y, at.zero.reach);
  for (int i = 0; i < 2; ++i) {
    const auto near = consistent.find_displaced(at, 1e-2 * tangents.next(), tangents.magnitude());
    if (!near.jet.zero.found) continue;
    const std::vector<int> counts = needed_differentiations(
        near.jet.array, near.jet.zero.y, near.jet.zero.uncertainty, ladder.index);
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
  bool stopped = false, has_converged = true;
  std::string singular;
  for (Index k = 0; k <= options_.max_level && !stopped; ++k) {
    jet.zero.y = jet.array.resized(jet.zero.y, k);
    const ConsistentJet next = consistent.find(jet);
    if (!next.zero.is_finite) {
      ladder.reason = not_finite(*system, next.array, next.array.resized(jet.zero.y, k)) +
                      ": the algorithm stops before level " + std::to_string(k) + ".";
      jet.zero.y = next.array.resized(jet.zero.y, k);
      break;
    }
    if (!next.zero.found) {
      // Where zeros of the last level are singular, those of this one need not be near.
      if (k > 0) {
        jet.zero.y = jet.array.resized(jet.zero.y, k - 1);
        singular = singularity(consistent, jet, ladder.levels, true);
        if (!singular.empty()) break;
      }
      if (!consistent.is_contradiction(next)) {
        has_converged = false;
        ladder.reason = "The search for a point of " + level_name("S", k) +
                        " did not converge, and the equations do not contradict each other where "
                        "it ended.";
        break;
      }
      LadderLevel empty;
      empty.k = k;
      empty.is_empty = true;
      empty.residual = next.array.residual(next.zero.y).lpNorm<Eigen::Infinity>();
      ladder.levels.push_back(empty);
      ladder.verdict = Verdict::inconsistent;
      ladder.reason = "No point of " + level_name("S", k) +
                      " was found near the given values: these equations contradict each other: " +
                      contradiction(*system, next.zero) + ".";
      jet.zero.y = next.array.resized(next.zero.y, k);
      break;
    }
    jet = next;
    ladder.levels = levels_at(consistent, jet);
    if (!contradictions(ladder.levels).empty()) break;
    stopped = repeats(ladder.levels);
    singular = singularity(consistent, jet, ladder.levels, stopped);
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
  ladder.doubts = contradictions(ladder.levels);
  if (!has_converged) ladder.doubts.push_back("A search that does not converge says nothing.");
  if (!ladder.levels.empty() && !ladder.levels.back().is_solved)
    ladder.doubts.push_back(
        "The equations do not vanish at the point to round-off: their solutions may be singular "
        "there.");
  if (ladder.levels.empty() || ladder.levels.back().is_empty) return ladder;
  if (ladder.verdict == Verdict::rank_change && !zeros_are_certain(jet))
    ladder.doubts.push_back(
        "Derivatives that seem to vanish at the point are not known well enough to say so.");

  const LadderLevel& last = ladder.levels.back();
  ladder.degrees_of_freedom = last.dim_M;
  ladder.gauge_dimension = last.fibre();
  if (ladder.verdict == Verdict::rank_change) return ladder;
  if (!stopped) {
    if (ladder.reason.empty() && contradictions(ladder.levels).empty())
      ladder.reason =
          "The dimensions still fell at level " + std::to_string(last.k) + ", the highest allowed.";
    else if (ladder.reason.empty())
      ladder.reason = "The levels contradict each other at level " + std::to_string(last.k) + ": " +
                      contradictions(ladder.levels).front();
    return ladder;
  }
  ladder.index = last.k - 1;
  ladder.verdict = ladder.gauge_dimension == 0 ? Verdict::regular : Verdict::gauge;
  describe(ladder, jet.array, jet.zero.y, jet.zero.uncertainty);
  count_differentiations_nearby(ladder, consistent, jet);
  return ladder;
}

}  // namespace courant
