#include "courant/integrators/ladder/singularity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "courant/core/structural_rank.hpp"
#include "courant/integrators/ladder/natural_scaling.hpp"
#include "courant/integrators/ladder/obstruction.hpp"

namespace courant {
namespace {

// What a point nearby says of a point.
struct Comparison {
  enum class Outcome {
    alike,      // the same ranks
    different,  // ranks that are higher nearby: those of the point are not constant around it
    lower,      // ranks that are lower nearby, where a number was taken for noise
    unknown,    // no point
  };
  Outcome outcome = Outcome::unknown;
  bool is_certain = true;
  bool is_proven = true;        // at least, of ranks that are alike
  bool is_hidden = false;       // whether round-off hides if equations follow
  bool is_beside = false;       // whether the direction, which is no tangent, does not tell
  std::string difference = "";  // in words
};

Comparison compare(const std::vector<LadderLevel>& here, const std::vector<LadderLevel>& nearby,
                   const std::string& place = "at a consistent point nearby") {
  using Outcome = Comparison::Outcome;
  Comparison result{.outcome = Outcome::alike};
  for (std::size_t k = 0; k < std::min(here.size(), nearby.size()); ++k) {
    const LadderLevel &a = here[k], &b = nearby[k];
    if (a.is_empty || (a.dim_S == b.dim_S && a.dim_M == b.dim_M)) continue;
    if (b.all.rank < a.all.rank || b.without_tangent.rank < a.without_tangent.rank ||
        b.without_point.rank < a.without_point.rank) {
      result.outcome = Outcome::lower;
      continue;
    }
    const std::string level = std::to_string(k);
    return {.outcome = Outcome::different,
            .difference = "(dim S_" + level + ", dim M_" + level + ") is (" +
                          std::to_string(a.dim_S) + ", " + std::to_string(a.dim_M) +
                          ") here and (" + std::to_string(b.dim_S) + ", " +
                          std::to_string(b.dim_M) + ") " + place + "."};
  }
  return result;
}

// Whether the bound of the errors proves the rank, and leaves nothing open. Bounds contain an estimate of how
// far the zero is that is meant: for itself alone a decision asks for more.
bool is_proven(const RankDecision& rank) {
  constexpr double above = 1.25, below = 0.5;
  return rank.above >= above && rank.below <= below;
}

template <class IsSure>
void clear_doubts(std::vector<LadderLevel>& levels, const IsSure& is_sure) {
  for (LadderLevel& level : levels)
    for (RankDecision* rank : {&level.all, &level.without_tangent, &level.without_point})
      if (is_sure(*rank)) rank->is_doubtful = false;
}

bool are_proven(const std::vector<LadderLevel>& levels) {
  return contradictions(levels).empty() &&
         std::ranges::all_of(levels, [](const LadderLevel& level) {
           return level.is_empty || (is_proven(level.all) && is_proven(level.without_tangent) &&
                                     is_proven(level.without_point));
         });
}

bool is_larger(const std::vector<LadderLevel>& there, const std::vector<LadderLevel>& here) {
  for (std::size_t k = 0; k < std::min(there.size(), here.size()); ++k)
    if (there[k].dim_M > here[k].dim_M) return true;
  return false;
}

}  // namespace

std::vector<LadderLevel> levels_at(const ConsistentJet& jet) {
  return ladder_levels(jet.array, jet.zero.y, jet.zero.uncertainty);
}

bool are_certain(const std::vector<LadderLevel>& levels) {
  return contradictions(levels).empty() &&
         std::none_of(levels.begin(), levels.end(),
                      [](const LadderLevel& level) { return level.is_ambiguous(); });
}

std::optional<RefinedArray> refined_with(const ConsistentJet& at,
                                         const std::vector<LadderLevel>& levels) {
  std::optional<RefinedArray> refined = RefinedArray::at(at.array, at.zero);
  if (!refined) return std::nullopt;
  const std::vector<LadderLevel> exact = ladder_levels(*refined, at.zero.y, at.zero.uncertainty);
  const bool is_alike =
      std::ranges::equal(exact, levels, [](const LadderLevel& a, const LadderLevel& b) {
        return a.is_solved && a.all.rank == b.all.rank &&
               a.without_tangent.rank == b.without_tangent.rank &&
               a.without_point.rank == b.without_point.rank;
      });
  return is_alike && are_certain(exact) ? std::move(refined) : std::nullopt;
}

void confirm(std::vector<LadderLevel>& levels) { clear_doubts(levels, is_proven); }

void settle(std::vector<LadderLevel>& levels) {
  clear_doubts(levels, [](const RankDecision&) { return true; });
}

bool are_ranks_of_pattern(const ConsistentJet& at, const std::vector<LadderLevel>& levels) {
  if (!are_proven(levels)) return false;
  const SparseMatrixXd pattern = GenericScaling(at.array, at.zero.y, at.zero.reach).magnitude;
  const Index n = at.array.base_size();
  return std::ranges::all_of(levels, [&](const LadderLevel& level) {
    const Index rows = at.array.row_count(level.k), columns = at.array.unknown_count(level.k);
    const auto largest_from = [&](Index first) {
      return structural_rank(pattern.block(0, first, rows, columns - first));
    };
    return level.all.rank == largest_from(0) && level.without_point.rank == largest_from(n) &&
           level.without_tangent.rank == largest_from(2 * n);
  });
}

Singularity singularity(const ConsistentPoint& consistent, const ConsistentJet& at,
                        const std::vector<LadderLevel>& levels, bool follow) {
  if (at.array.has_constant_jacobian()) return {.is_confirmed = true};
  using Outcome = Comparison::Outcome;
  constexpr Index dense_limit = 200;
  const bool is_small = at.zero.y.size() <= dense_limit;
  std::optional<Obstruction> obstruction;
  TangentDisplacement tangents(at.array, at.zero.y, at.zero.reach);
  if (follow && is_small)
    obstruction.emplace(at.array, at.zero.y, at.zero.uncertainty, levels.back().all.rank,
                        tangents.magnitude());
  // What round-off hides may be seen with more digits.
  constexpr double blurred = 1e-13;
  std::optional<RefinedArray> refined;
  std::optional<Obstruction> refined_obstruction;
  bool is_refined = false;
  const auto seen_along = [&](const VectorXd& tangent) {
    using Answer = Obstruction::Answer;
    const Answer answer = obstruction ? obstruction->is_seen_along(tangent) : Answer::no;
    if (answer != Answer::unknown) return answer;
    if (!is_refined && (refined = refined_with(at, levels)))
      refined_obstruction.emplace(*refined, at.zero.y, at.zero.uncertainty, levels.back().all.rank,
                                  tangents.magnitude(), blurred);
    is_refined = true;
    return refined_obstruction && refined_obstruction->is_seen_along(tangent) == Answer::no
               ? Answer::no
               : answer;
  };
  const auto look_along = [&](const VectorXd& tangent) -> Comparison {
    const auto near = consistent.find_displaced(at, 1e-3 * tangent, tangents.magnitude());
    Comparison result;
    if (near.jet.zero.found) {
      const std::vector<LadderLevel> there = levels_at(near.jet);
      result = compare(levels, there);
      result.is_certain = are_certain(there);
      result.is_proven = are_proven(there);
      if (result.outcome == Outcome::different) return result;
    }
    const auto seen = seen_along(tangent);
    if (seen == Obstruction::Answer::no) return result;
    if (seen == Obstruction::Answer::beside) {
      result.is_beside = true;
      return result;
    }
    if (seen == Obstruction::Answer::unknown) {
      result.is_hidden = true;
      return result;
    }
    return {.outcome = Outcome::different,
            .is_certain = seen == Obstruction::Answer::yes,
            .difference =
                "The equations have solutions in fewer directions than their linear parts: one of "
                "the constraints has a vanishing gradient here."};
  };
  using Units = TangentDisplacement::Units;
  constexpr std::array units = {Units::own_sizes, Units::large_where_zero, Units::natural,
                                Units::own_sizes, Units::large_where_zero};
  int alike = 0, nothing_hidden = 0, different = 0, compared = 0, proven = 0;
  bool is_hidden = false;
  std::string certain, uncertain;
  for (const Units unit : units) {
    const Comparison comparison = look_along(
        tangents.next(is_small || unit != Units::large_where_zero ? unit : Units::natural));
    is_hidden = is_hidden || comparison.is_hidden;
    if (comparison.outcome == Outcome::alike && comparison.is_certain && !comparison.is_hidden) {
      ++alike;
      if (!comparison.is_beside) ++nothing_hidden;
    }
    if (comparison.outcome == Outcome::alike || comparison.outcome == Outcome::lower) ++compared;
    if (comparison.outcome == Outcome::alike && comparison.is_proven) ++proven;
    if (comparison.outcome == Outcome::different && !comparison.is_certain)
      uncertain = comparison.difference;
    if (comparison.outcome == Outcome::different && comparison.is_certain) {
      if (++different == 1) certain = comparison.difference;
    }
    if (different == 3 || (nothing_hidden == 2 && different == 0)) break;
  }
  // Ranks that hold at this instant only, as that of t at t = 0, are not those of a motion.
  if (at.array.depends_on_time() && different == 0) {
    constexpr std::array moments = {1e-3, 1e-2};
    const VectorXd nothing = VectorXd::Zero(at.zero.y.size());
    for (const double moment : moments) {
      const auto near = consistent.find_later(at, nothing, moment * tangents.time_unit());
      if (!near.jet.zero.found) continue;
      const std::vector<LadderLevel> there = levels_at(near.jet);
      const Comparison comparison = compare(levels, there, "a moment later");
      if (comparison.outcome != Outcome::different || !are_certain(there)) continue;
      if (++different == 1) certain = comparison.difference;
    }
    if (different == 2) return {.reason = certain};
  }
  // A singular point looks singular from everywhere: two directions in which nothing is hidden are enough.
  if (is_hidden && nothing_hidden < 2 && uncertain.empty())
    uncertain =
        "Round-off hides whether the equations have solutions in all directions that their linear "
        "parts have, or a constraint has a vanishing gradient here.";
  const std::string& seen = certain.empty() ? uncertain : certain;
  if (different >= 2 && different > alike) return {.reason = certain, .is_unanimous = alike == 0};
  return {
      .seen_once = seen, .is_compared = compared >= 2, .is_confirmed = seen.empty() && proven >= 2};
}

bool is_same_rank_at(const ConsistentJet& at, const std::vector<LadderLevel>& levels,
                     bool lowered) {
  constexpr double far_below = 1e-3;
  const auto is_hidden = [](const RankDecision& rank) { return rank.below > far_below; };
  if (!lowered && std::none_of(levels.begin(), levels.end(), [&](const LadderLevel& level) {
        return is_hidden(level.all) || is_hidden(level.without_tangent) ||
               is_hidden(level.without_point);
      }))
    return true;
  const std::vector<LadderLevel> exact =
      ladder_levels(at.array, at.zero.y, (lowered ? 0.0 : far_below) * at.zero.uncertainty);
  return compare(levels, exact).outcome != Comparison::Outcome::different ||
         (!lowered && !are_certain(exact));
}

bool is_lower_where_given(const ConsistentPoint& consistent, const ConsistentJet& at,
                          const std::vector<LadderLevel>& levels) {
  constexpr double next_to = 1e-3;
  const DerivativeArray given = consistent.start().array;
  const VectorXd moved = at.array.origin() - given.origin();
  if (moved.isZero(0.0) || at.array.has_constant_jacobian() || given.base_size() != moved.size() ||
      moved.lpNorm<Eigen::Infinity>() > next_to * given.origin().lpNorm<Eigen::Infinity>())
    return false;
  return compare(ladder_levels(given, at.zero.y, at.zero.uncertainty), levels).outcome ==
         Comparison::Outcome::different;
}

bool has_clear_cuts(const std::vector<LadderLevel>& levels) {
  constexpr double far = 1e5;
  const auto is_clear = [](const RankDecision& rank) {
    return rank.below <= 0.0 || rank.rank == 0 || rank.above >= far * rank.below;
  };
  return std::all_of(levels.begin(), levels.end(), [&](const LadderLevel& level) {
    return is_clear(level.all) && is_clear(level.without_tangent) && is_clear(level.without_point);
  });
}

Branching branching(const ConsistentPoint& consistent, const ConsistentJet& at,
                    const ConstraintLadder& ladder) {
  constexpr Index dense_limit = 200;
  constexpr double away = 0.05;  // of a displacement: its part across M_{k+1}
  constexpr int directions = 4, needed = 2;
  const std::vector<LadderLevel>& levels = ladder.levels;
  if (at.array.has_constant_jacobian() || at.zero.y.size() > dense_limit) return {};
  const Index n = at.array.base_size(), top = at.array.level_of(at.zero.y);
  const VectorXd here = at.zero.y.head(n);
  for (std::size_t k = 0; k + 1 < levels.size(); ++k) {
    if (levels[k + 1].is_empty || levels[k + 1].dim_M >= levels[k].dim_M) continue;
    ConsistentJet lower = at;
    const auto level = static_cast<Index>(k);
    lower.zero.y = at.array.resized(at.zero.y, level);
    lower.zero.reach = at.array.resized(at.zero.reach, level);
    lower.zero.uncertainty = at.array.resized(at.zero.uncertainty, level);
    TangentDisplacement tangents(lower.array, lower.zero.y, lower.zero.reach);
    const auto is_across = [&](const VectorXd& moved) {
      return std::ranges::any_of(ladder.constraints, [&](const PointConstraint& constraint) {
        return constraint.level == level + 1 &&
               std::fabs(constraint.gradient.dot(moved)) >
                   away * constraint.gradient.cwiseAbs().dot(moved.cwiseAbs());
      });
    };
    int met = 0, compared = 0;
    bool is_confirmed = true;
    for (int direction = 0; direction < directions && compared < needed; ++direction) {
      ConsistentJet near =
          consistent.find_displaced(lower, 1e-3 * tangents.next(), tangents.magnitude()).jet;
      if (!near.zero.found || !is_across(at.array.basis() * (near.zero.y.head(n) - here))) continue;
      ++compared;
      for (Index above = level + 1; near.zero.found && above <= std::min(level + 2, top); ++above) {
        near.zero.y = at.array.resized(near.zero.y, above);
        near = consistent.find_at(near, near.zero.y.head(n));
      }
      if (!near.zero.found) break;
      // Errors may hide that a point across has no velocity: with more digits the zero moves back, or is none.
      if (const auto refined = RefinedArray::at(near.array, near.zero); !refined)
        is_confirmed = false;
      else if (!is_across(at.array.basis() *
                          (near.zero.y.head(n) + refined->correction().head(n) - here)))
        break;
      const ConsistentJet back = consistent.find_at(near, here);
      if (!back.zero.found) break;
      const std::vector<LadderLevel> there = levels_at(back);
      if (!are_certain(there) || !is_larger(there, levels)) break;
      ++met;
    }
    if (met < needed) continue;
    return {.reason = "Solutions branch here: M_" + std::to_string(k + 1) + " has dimension " +
                      std::to_string(levels[k + 1].dim_M) +
                      " along the velocity of the point, and more along another one.",
            .is_confirmed = is_confirmed};
  }
  return {};
}

}  // namespace courant
