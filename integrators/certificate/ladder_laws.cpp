#include "courant/integrators/certificate/ladder_laws.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace courant {
namespace {

double amount(Index value) { return static_cast<double>(std::max<Index>(0, value)); }

std::string at_level(const LadderLevel& level) { return "level " + std::to_string(level.k); }

}  // namespace

std::vector<LawResult> check_ladder(const ConstraintLadder& ladder, Index manifold_dimension) {
  const std::string subject = "ConstraintLadder";
  LawMeasurement nested(subject, "N1 dim S_k and dim M_k do not increase", 0.0);
  LawMeasurement possible(subject, "N2 0 ≤ dim M_k ≤ n, 0 ≤ dim S_k - dim M_k ≤ n", 0.0);
  LawMeasurement agrees(subject, "N3 M_k has n - dim M_k constraints of level k or less", 0.0);
  LawMeasurement final_law(subject, "N4 the ladder stops where two levels are equal", 0.0);
  const bool ended = ladder.verdict == Verdict::regular || ladder.verdict == Verdict::gauge;

  const LadderLevel* before = nullptr;
  for (const LadderLevel& level : ladder.levels) {
    if (level.is_empty) break;
    const std::string where = at_level(level);
    nested.add(
        before ? amount(level.dim_S - before->dim_S) + amount(level.dim_M - before->dim_M) : 0.0,
        where);
    possible.add(amount(-level.dim_M) + amount(level.dim_M - manifold_dimension) +
                     amount(-level.fibre()) + amount(level.fibre() - manifold_dimension),
                 where);
    if (ended && level.k <= ladder.index) {
      const auto found = std::ranges::count_if(
          ladder.constraints, [&](const PointConstraint& c) { return c.level <= level.k; });
      agrees.add(static_cast<double>(std::abs(manifold_dimension - level.dim_M - found)), where);
    }
    before = &level;
  }
  std::vector<LawResult> results;
  if (before) {
    results.push_back(nested.result());
    results.push_back(possible.result());
  }
  if (!ended) return results;
  const std::size_t count = ladder.levels.size();
  if (count < 2) {
    final_law.add(1.0, "fewer than two levels");
  } else {
    const LadderLevel &last = ladder.levels[count - 1], &previous = ladder.levels[count - 2];
    const Index off =
        std::abs(last.dim_S - previous.dim_S) + std::abs(last.dim_M - previous.dim_M) +
        std::abs(ladder.gauge_dimension - last.fibre()) +
        std::abs(ladder.degrees_of_freedom - last.dim_M) + std::abs(ladder.index - previous.k);
    final_law.add(static_cast<double>(off), at_level(last));
  }
  results.push_back(agrees.result());
  results.push_back(final_law.result());
  return results;
}

}  // namespace courant
