#include "courant/integrators/certificate/constraint_algorithm.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "courant/integrators/certificate/bifurcation.hpp"
#include "courant/integrators/certificate/chart_equations.hpp"
#include "courant/integrators/certificate/consistent_point.hpp"
#include "courant/integrators/certificate/ladder_ascent.hpp"
#include "courant/integrators/certificate/ladder_evidence.hpp"
#include "courant/integrators/certificate/ladder_levels.hpp"
#include "courant/integrators/certificate/movements.hpp"

namespace courant {
namespace {

// Counts what other points of the final constraint set need as well, now and a moment later: a
// multiplier that is zero at this point, as x₁ of a rod in the plane x₁ = 0, is not along a motion
// that leaves it, nor that of a rope that hangs straight until its crane begins to move. Sizes are those of the jet, `nominal`.
void count_differentiations_nearby(ConstraintLadder& ladder, const ConsistentPoint& consistent,
                                   const ConsistentJet& at, const VectorXd& nominal) {
  TangentDisplacement tangents(at.array(), at.zero().y, nominal);
  constexpr double nearby = 1e-2;
  const int looks = at.array().depends_on_time() ? 4 : 2;
  for (int i = 0; i < looks; ++i) {
    const VectorXd displacement = nearby * tangents.next();
    const auto near = i < 2
                          ? consistent.find_displaced(at, displacement, tangents.magnitude())
                          : consistent.find_later(at, displacement, nearby * tangents.time_unit());
    if (!near.jet.zero().found) continue;
    const std::vector<int> counts = needed_differentiations(
        near.jet.array(), near.jet.zero().y, near.jet.zero().uncertainty, ladder.index);
    for (std::size_t e = 0; e < counts.size(); ++e)
      ladder.differentiations[e] = std::max(ladder.differentiations[e], counts[e]);
  }
}

// By two sizes: a coordinate of 10⁻⁹ beside others may be small, or stand for zero, and then nothing is seen of what is
// needed as near as that.
void count_differentiations_nearby(ConstraintLadder& ladder, const ConsistentPoint& consistent,
                                   const ConsistentJet& at) {
  const Index n = at.array().base_size();
  if (at.array().has_constant_jacobian() || n == 0) return;
  VectorXd nominal = at.zero().nominal;
  count_differentiations_nearby(ladder, consistent, at, nominal);
  if (nominal.head(n).minCoeff() == nominal.head(n).maxCoeff()) return;
  for (const Index first : {Index{0}, n})
    nominal.segment(first, n).setConstant(nominal.segment(first, n).maxCoeff());
  count_differentiations_nearby(ladder, consistent, at, nominal);
}

// Why the levels did not end.
std::string reason_to_go_on(const LadderAscent& ascent) {
  const std::string last = std::to_string(ascent.levels.back().k);
  const std::vector<std::string> contradicted = contradictions(ascent.levels);
  return contradicted.empty()
             ? "The dimensions still fell at level " + last + ", the highest allowed."
             : "The levels contradict each other at level " + last + ": " + contradicted.front();
}

// Takes the index back where solutions branch at the point; whether they do.
bool is_bifurcation(ConstraintLadder& ladder, const ConsistentPoint& consistent,
                    const ConsistentJet& at, const LadderEvidence& evidence) {
  Bifurcation branches = bifurcation(consistent, at, ladder);
  if (branches.reason.empty()) return false;
  ladder.verdict = Verdict::rank_change;
  ladder.index = -1;
  ladder.reason = std::move(branches.reason);
  if (!branches.is_confirmed)
    ladder.doubts.push_back(
        "Points next to this one, from which another velocity leads here, are no zeros with more "
        "digits.");
  if (evidence.is_proven || evidence.is_refined)
    ladder.doubts.push_back(
        "The ranks along the velocity that was found are proven, and what else is known of the "
        "point leaves doubts.");
  return true;
}

}  // namespace

ConstraintLadder ConstraintAlgorithm::run(const std::shared_ptr<const ImplicitSystem>& system,
                                          const InitialGuess& guess) const {
  if (!system) throw std::invalid_argument("ConstraintAlgorithm::run: system is null.");
  return run(std::make_shared<const ChartEquations>(system), guess);
}

ConstraintLadder ConstraintAlgorithm::run(const std::shared_ptr<const ChartEquations>& equations,
                                          const InitialGuess& guess) const {
  const ImplicitSystem& system = *equations->system();
  const ConsistentPoint consistent(equations, guess, options_.metric);
  LadderAscent ascent(consistent, system, options_.max_level);
  const LadderEvidence evidence(ascent);
  const ConsistentJet& jet = ascent.jet;

  ConstraintLadder ladder;
  ladder.levels = ascent.levels;
  ladder.point = jet.array().state(jet.zero().y);
  ladder.jet = jet.zero().y;
  ladder.moved = consistent.distance(ladder.point.x);
  ladder.moves = movements(system, guess, ladder.point);
  ladder.doubts = doubts(consistent, ascent, evidence);
  ladder.reason = ascent.is_singular() ? ascent.singular.reason : ascent.reason;
  if (!ascent.is_singular()) ladder.contradiction = ascent.contradiction;
  if (ascent.is_singular())
    ladder.verdict = Verdict::rank_change;
  else if (!ladder.levels.empty() && ladder.levels.back().is_empty)
    ladder.verdict = Verdict::inconsistent;
  if (!ascent.has_point()) return ladder;

  const LadderLevel& last = ladder.levels.back();
  ladder.degrees_of_freedom = last.dim_M;
  ladder.gauge_dimension = last.fibre();
  if (ascent.is_singular()) return ladder;
  if (!ascent.is_stopped) {
    if (ladder.reason.empty()) ladder.reason = reason_to_go_on(ascent);
    return ladder;
  }
  ladder.index = last.k - 1;
  ladder.verdict = ladder.gauge_dimension == 0 ? Verdict::regular : Verdict::gauge;
  describe(ladder, jet.array(), jet.zero().y, jet.zero().uncertainty);
  if (!is_bifurcation(ladder, consistent, jet, evidence))
    count_differentiations_nearby(ladder, consistent, jet);
  return ladder;
}

}  // namespace courant
