#include "courant/integrators/ladder/constraint_algorithm.hpp"

#include <algorithm>
#include <cmath>

#include "courant/core/text_layout.hpp"
#include "courant/integrators/ladder/consistent_point.hpp"
#include "courant/integrators/ladder/ladder_levels.hpp"
#include "courant/integrators/ladder/natural_scaling.hpp"
#include "courant/integrators/ladder/singularity.hpp"

namespace courant {
namespace {

bool repeats(const std::vector<LadderLevel>& levels) {
  if (levels.size() < 2) return false;
  const LadderLevel& last = levels.back();
  const LadderLevel& before = levels[levels.size() - 2];
  return last.dim_S == before.dim_S && last.dim_M == before.dim_M;
}

// What a search for a point of the next level changed of the levels before, in words; empty if nothing.
std::string change(const std::vector<LadderLevel>& before, const std::vector<LadderLevel>& now) {
  for (std::size_t k = 0; k < std::min(before.size(), now.size()); ++k)
    if (before[k].dim_S != now[k].dim_S || before[k].dim_M != now[k].dim_M)
      return "Level " + std::to_string(k) + " has other dimensions at the point of level " +
             std::to_string(before.size() - 1) + " than at that of level " +
             std::to_string(now.size() - 1) + ".";
  return "";
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
    names +=
        i < 0 ? ""
              : time_derivative(system.names().equations[static_cast<std::size_t>(i % r)], i / r);
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
               ? "The derivatives of " + time_derivative(name, i / r) +
                     " are not finite at the given values"
               : time_derivative(name, i / r) + " is not finite at the given values";
  }
  return "The equations are not finite at the given values";
}

// What is not as it should be one level above the last, in words; empty if nothing. Equations that follow
// from others do so with their derivatives. One without a linear part at the point, as z² = 0 at 0,
// looks as if it did; its derivatives 2 z z' and 2 z z'' + 2 z'² then ask for more.
std::string asked_above(const ConsistentPoint& consistent, const ConsistentJet& at,
                        const std::vector<LadderLevel>& levels) {
  const LadderLevel& last = levels.back();
  if (at.array.has_constant_jacobian() || last.all.rank == last.all.rows) return "";
  ConsistentJet start = at;
  start.zero.y = at.array.resized(at.zero.y, last.k + 1);
  const ConsistentJet above = consistent.find(start);
  const std::string place = "S" + subscript(last.k + 1);
  if (!above.zero.found)
    return "No point of " + place +
           " was found, though equations follow from others up to the level before.";
  const std::vector<LadderLevel> there = levels_at(above);
  if ((!there.back().is_solved || !are_certain(there)) && !refined_with(above, there))
    return "What is known at " + place +
           " leaves open whether equations that follow from others do so there.";
  if (const std::string changed = change(levels, there); !changed.empty()) return changed;
  return repeats(there) ? "" : "The dimensions fall again at " + place + ".";
}

// Whether the errors of the derivatives at the jet are small next to what the equations are made of
// around it, each unknown by its natural unit. In a row where they are not, entries may have been lost
// in their errors, and ranks with them: where numbers of 10¹⁰ cancel, for example, that a search came
// by.
bool is_known_well(const ConsistentJet& at) {
  constexpr double certain = 1.0;
  const VectorXd& y = at.zero.y;
  Linearization here =
      at.array.linearize(y, at.zero.uncertainty.cwiseMax(Prolongation::rounding(y)));
  const SparseMatrixXd nearby = GenericScaling(at.array, y, at.zero.reach).magnitude;
  // Of what vanishes around the point too, as sin² + cos² - 1 does, the uncertainty of the point makes
  // nothing.
  const SparseMatrixXd rounding = at.array.linearize(y).error;
  for (Index j = 0; j < here.error.outerSize(); ++j)
    for (SparseMatrixXd::InnerIterator it(here.error, j); it; ++it)
      if (nearby.coeff(it.row(), j) == 0.0)
        it.valueRef() = std::min(it.value(), rounding.coeff(it.row(), j));
  const NaturalScaling units({VectorXd::Zero(here.value.size()), nearby}, at.zero.reach, 1e-9,
                             1e-10);
  // Of one measure alone too little is known: units come from equations whose entries may vanish, sizes
  // from unknowns that may.
  const auto is_small = [&](const VectorXd& size) -> Eigen::Array<bool, Eigen::Dynamic, 1> {
    const auto largest_by_row = [&](const SparseMatrixXd& M) {
      VectorXd largest = VectorXd::Zero(M.rows());
      for (Index j = 0; j < M.outerSize(); ++j)
        for (SparseMatrixXd::InnerIterator it(M, j); it; ++it)
          largest[it.row()] = std::max(largest[it.row()], std::fabs(it.value()) * size[j]);
      return largest;
    };
    return largest_by_row(here.error).array() <= certain * largest_by_row(nearby).array();
  };
  return (is_small(units.column_scale) || is_small(at.zero.reach)).all();
}

// Counts what other points of the final constraint set need as well, now and a moment later: a
// multiplier that is zero at this point, as x₁ of a rod in the plane x₁ = 0, is not along a motion
// that leaves it, nor that of a rope that hangs straight until its crane begins to move.
void count_differentiations_nearby(ConstraintLadder& ladder, const ConsistentPoint& consistent,
                                   const ConsistentJet& at) {
  if (at.array.has_constant_jacobian()) return;
  TangentDisplacement tangents(at.array, at.zero.y, at.zero.reach);
  constexpr double nearby = 1e-2;
  const int looks = at.array.depends_on_time() ? 4 : 2;
  for (int i = 0; i < looks; ++i) {
    const VectorXd displacement = nearby * tangents.next();
    const auto near = i < 2
                          ? consistent.find_displaced(at, displacement, tangents.magnitude())
                          : consistent.find_later(at, displacement, nearby * tangents.time_unit());
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
  Singularity singular;
  std::string changed;
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
        if (!singular.reason.empty()) break;
      }
      if (!consistent.is_contradiction(next)) {
        has_converged = false;
        ladder.reason = "The search for a point of S" + subscript(k) +
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
      ladder.reason = "No point of S" + subscript(k) +
                      " was found near the given values: these equations contradict each other: " +
                      contradiction(*system, next.zero) + ".";
      jet.zero.y = next.array.resized(next.zero.y, k);
      break;
    }
    jet = next;
    std::vector<LadderLevel> levels = levels_at(consistent, jet);
    if (changed.empty()) changed = change(ladder.levels, levels);
    ladder.levels = std::move(levels);
    if (!contradictions(ladder.levels).empty()) break;
    stopped = repeats(ladder.levels);
    const std::string before = std::move(singular.seen_once);
    singular = singularity(consistent, jet, ladder.levels, stopped);
    if (singular.seen_once.empty()) singular.seen_once = before;
    if (!singular.reason.empty()) break;
  }
  // Levels that contradict each other at a point that looks singular from one side: so it is.
  if (singular.reason.empty() && !singular.seen_once.empty() &&
      !contradictions(ladder.levels).empty()) {
    singular.reason = std::move(singular.seen_once);
    singular.is_unanimous = false;
  }
  const bool has_point = !ladder.levels.empty() && !ladder.levels.back().is_empty;
  bool is_known = !has_point || is_known_well(jet);
  // Ranks that are proven from below by the bounds of errors and from above by the pattern of the equations need
  // no points nearby; with full rank of all equations there is a zero, and no entry that could have been lost.
  bool is_proven = false, is_full = false;
  if (stopped && singular.reason.empty()) {
    const LadderLevel& last = ladder.levels.back();
    const bool is_doubtful =
        !are_certain(ladder.levels) || !singular.is_compared || !last.is_solved || !is_known;
    is_proven = is_doubtful && are_ranks_of_pattern(jet, ladder.levels);
    is_full = is_proven && last.all.rank == last.all.rows;
    if (singular.is_confirmed || is_full) confirm(ladder.levels);
  }
  const bool is_rank_change = !singular.reason.empty();
  bool is_refined = false;
  bool is_same_rank = !has_point || is_same_rank_at(jet, ladder.levels, is_rank_change);
  // What 53 bits leave open of the ranks at the point, 113 may settle.
  if (has_point && stopped && !is_rank_change && contradictions(ladder.levels).empty() &&
      !(is_known && is_same_rank && are_certain(ladder.levels)) &&
      refined_with(jet, ladder.levels)) {
    is_known = is_same_rank = is_refined = true;
    settle(ladder.levels);
  }
  ladder.point = jet.array.state(jet.zero.y);
  ladder.jet = jet.zero.y;
  ladder.moved = consistent.distance(ladder.point.x);
  ladder.moves = movements(*system, guess, ladder.point);
  if (!singular.reason.empty()) {
    ladder.verdict = Verdict::rank_change;
    ladder.reason = singular.reason;
  }
  ladder.doubts = contradictions(ladder.levels);
  if (!changed.empty()) ladder.doubts.push_back(changed);
  if (singular.reason.empty() && !singular.seen_once.empty())
    ladder.doubts.push_back("In one direction the point may be singular: " + singular.seen_once);
  if (stopped && singular.reason.empty())
    if (std::string doubt = asked_above(consistent, jet, ladder.levels); !doubt.empty())
      ladder.doubts.push_back(std::move(doubt));
  if (!singular.is_compared && !is_proven)
    ladder.doubts.push_back("Too few points nearby could be compared with this one.");
  if (!singular.is_unanimous)
    ladder.doubts.push_back("In one direction the point does not look singular.");
  if (!has_converged) ladder.doubts.push_back("A search that does not converge says nothing.");
  if (!ladder.levels.empty() && !ladder.levels.back().is_solved && !is_full)
    ladder.doubts.push_back(
        "The equations do not vanish at the point to round-off: their solutions may be singular "
        "there.");
  if (!has_point) return ladder;
  if (!is_same_rank)
    ladder.doubts.push_back(
        "The ranks are higher at the point as it was found: they are lower only if it is "
        "elsewhere, "
        "within its error.");
  if (ladder.verdict != Verdict::rank_change &&
      is_lower_where_given(consistent, jet, ladder.levels))
    ladder.doubts.push_back(
        "The ranks are lower at the given values, which had to move a little: these look singular, "
        "and "
        "the point that was found next to them does not.");
  if (ladder.verdict == Verdict::rank_change && !has_clear_cuts(ladder.levels))
    ladder.doubts.push_back(
        "The ranks at the point are lower than nearby by numbers that are hardly below their "
        "errors.");
  if (!is_known && !is_full)
    ladder.doubts.push_back(
        "The derivatives of the equations are not known well enough at the point to say which of "
        "them vanish.");

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
  if (Branching branches = branching(consistent, jet, ladder); !branches.reason.empty()) {
    ladder.verdict = Verdict::rank_change;
    ladder.index = -1;
    ladder.reason = std::move(branches.reason);
    if (!branches.is_confirmed)
      ladder.doubts.push_back(
          "Points next to this one, from which another velocity leads here, are no zeros with more "
          "digits.");
    if (is_proven || is_refined)
      ladder.doubts.push_back(
          "The ranks along the velocity that was found are proven, and what else is known of the "
          "point leaves doubts.");
    return ladder;
  }
  count_differentiations_nearby(ladder, consistent, jet);
  return ladder;
}

}  // namespace courant
