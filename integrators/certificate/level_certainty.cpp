#include "courant/integrators/certificate/level_certainty.hpp"

#include <algorithm>

#include "courant/core/linear/structural_rank.hpp"
#include "courant/integrators/certificate/natural_scaling.hpp"

namespace courant {
namespace {

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

}  // namespace

std::vector<LadderLevel> levels_at(const ConsistentJet& jet) {
  return ladder_levels(jet.array(), jet.zero().y, jet.zero().uncertainty);
}

bool are_certain(const std::vector<LadderLevel>& levels) {
  return contradictions(levels).empty() &&
         std::none_of(levels.begin(), levels.end(),
                      [](const LadderLevel& level) { return level.is_ambiguous(); });
}

std::optional<RefinedArray> refined_with(const ConsistentJet& at,
                                         const std::vector<LadderLevel>& levels) {
  std::optional<RefinedArray> refined = RefinedArray::at(at.array(), at.zero());
  if (!refined) return std::nullopt;
  const std::vector<LadderLevel> exact =
      ladder_levels(*refined, at.zero().y, at.zero().uncertainty);
  const bool is_alike =
      std::ranges::equal(exact, levels, [](const LadderLevel& a, const LadderLevel& b) {
        return a.is_solved && a.all.rank == b.all.rank &&
               a.without_tangent.rank == b.without_tangent.rank &&
               a.without_point.rank == b.without_point.rank;
      });
  return is_alike && are_certain(exact) ? std::move(refined) : std::nullopt;
}

bool has_refined_ranks(const ConsistentJet& at, const std::vector<LadderLevel>& levels) {
  return refined_with(at, levels).has_value();
}

bool are_proven(const std::vector<LadderLevel>& levels) {
  return contradictions(levels).empty() &&
         std::ranges::all_of(levels, [](const LadderLevel& level) {
           return level.is_empty || (is_proven(level.all) && is_proven(level.without_tangent) &&
                                     is_proven(level.without_point));
         });
}

void confirm(std::vector<LadderLevel>& levels) { clear_doubts(levels, is_proven); }

void settle(std::vector<LadderLevel>& levels) {
  clear_doubts(levels, [](const RankDecision&) { return true; });
}

bool are_ranks_of_pattern(const ConsistentJet& at, const std::vector<LadderLevel>& levels) {
  if (!are_proven(levels)) return false;
  const SparseMatrixXd pattern =
      GenericScaling(at.array(), at.zero().y, at.zero().nominal).magnitude;
  const Index n = at.array().base_size();
  return std::ranges::all_of(levels, [&](const LadderLevel& level) {
    const Index rows = at.array().row_count(level.k), columns = at.array().unknown_count(level.k);
    const auto largest_from = [&](Index first) {
      return structural_rank(pattern.block(0, first, rows, columns - first));
    };
    return level.all.rank == largest_from(0) && level.without_point.rank == largest_from(n) &&
           level.without_tangent.rank == largest_from(2 * n);
  });
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

}  // namespace courant
