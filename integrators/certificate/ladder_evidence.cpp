#include "courant/integrators/certificate/ladder_evidence.hpp"

#include <algorithm>
#include <cmath>

#include "courant/core/words/text_layout.hpp"
#include "courant/integrators/certificate/level_certainty.hpp"
#include "courant/integrators/certificate/natural_scaling.hpp"

namespace courant {
namespace {

// What is not as it should be one level above the last, in words; empty if nothing. Equations that follow
// from others do so with their derivatives. One without a linear part at the point, as z² = 0 at 0,
// looks as if it did; its derivatives 2 z z' and 2 z z'' + 2 z'² then ask for more.
std::string asked_above(const ConsistentPoint& consistent, const ConsistentJet& at,
                        const std::vector<LadderLevel>& levels) {
  const LadderLevel& last = levels.back();
  if (at.array().has_constant_jacobian() || last.all.rank == last.all.rows) return "";
  const ConsistentJet above = consistent.find(at.at_level(last.k + 1));
  const std::string place = "S" + subscript(last.k + 1);
  if (!above.zero().found)
    return "No point of " + place +
           " was found, though equations follow from others up to the level before.";
  const std::vector<LadderLevel> there = levels_at(above);
  if ((!there.back().is_solved || !are_certain(there)) && !has_refined_ranks(above, there))
    return "What is known at " + place +
           " leaves open whether equations that follow from others do so there.";
  if (std::string changed = change(levels, there); !changed.empty()) return changed;
  return repeats(there) ? "" : "The dimensions fall again at " + place + ".";
}

// Whether the errors of the derivatives at the jet are small next to what the equations are made of
// around it, each unknown by its natural unit. In a row where they are not, entries may have been lost
// in their errors, and ranks with them: where numbers of 10¹⁰ cancel, for example, that a search came
// by.
bool is_known_well(const ConsistentJet& at) {
  constexpr double certain = 1.0;
  const VectorXd& y = at.zero().y;
  Linearization here =
      at.array().linearize(y, at.zero().uncertainty.cwiseMax(Prolongation::rounding(y)));
  const SparseMatrixXd nearby = GenericScaling(at.array(), y, at.zero().nominal).magnitude;
  // Of what vanishes around the point too, as sin² + cos² - 1 does, the uncertainty of the point makes
  // nothing.
  const SparseMatrixXd rounding = at.array().linearize(y).error;
  for (Index j = 0; j < here.error.outerSize(); ++j)
    for (SparseMatrixXd::InnerIterator it(here.error, j); it; ++it)
      if (nearby.coeff(it.row(), j) == 0.0)
        it.valueRef() = std::min(it.value(), rounding.coeff(it.row(), j));
  const NaturalScaling units({VectorXd::Zero(here.value.size()), nearby}, at.zero().nominal, 1e-9,
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
  return (is_small(units.column_scale) || is_small(at.zero().nominal)).all();
}

}  // namespace

LadderEvidence::LadderEvidence(LadderAscent& ascent) {
  const bool has_point = ascent.has_point(), is_singular = ascent.is_singular();
  std::vector<LadderLevel>& levels = ascent.levels;
  const Singularity& singular = ascent.singular;
  is_known = !has_point || is_known_well(ascent.jet);
  if (ascent.is_stopped && !is_singular) {
    const LadderLevel& last = levels.back();
    const bool is_doubtful =
        !are_certain(levels) || !singular.is_compared || !last.is_solved || !is_known;
    is_proven = is_doubtful && are_ranks_of_pattern(ascent.jet, levels);
    is_full = is_proven && last.all.rank == last.all.rows;
    if (singular.is_confirmed || is_full) confirm(levels);
  }
  is_same_rank = !has_point || is_same_rank_at(ascent.jet, levels, is_singular);
  const bool is_certain = is_known && is_same_rank && are_certain(levels);
  if (!has_point || !ascent.is_stopped || is_singular || !contradictions(levels).empty() ||
      is_certain)
    return;
  // What 53 bits leave open of the ranks at the point, 113 may settle.
  is_refined = singular.is_refined ? *singular.is_refined : has_refined_ranks(ascent.jet, levels);
  if (!is_refined) return;
  is_known = is_same_rank = true;
  settle(levels);
}

std::vector<Doubt> doubts(const ConsistentPoint& consistent, const LadderAscent& ascent,
                          const LadderEvidence& evidence) {
  const std::vector<LadderLevel>& levels = ascent.levels;
  const Singularity& singular = ascent.singular;
  const bool is_singular = ascent.is_singular();
  const std::vector<std::string> contradicting = contradictions(levels);
  std::vector<Doubt> result(contradicting.begin(), contradicting.end());
  const auto add_if = [&](bool is_so, const char* sentence) {
    if (is_so) result.emplace_back(sentence);
  };
  if (!ascent.changed.empty()) result.push_back(ascent.changed);
  if (!is_singular && !singular.seen_once.empty())
    result.push_back("In one direction the point may be singular: " + singular.seen_once);
  if (ascent.is_stopped && !is_singular)
    if (std::string doubt = asked_above(consistent, ascent.jet, levels); !doubt.empty())
      result.push_back(std::move(doubt));
  add_if(!singular.is_compared && !evidence.is_proven,
         "Too few points nearby could be compared with this one.");
  add_if(!singular.is_unanimous, "In one direction the point does not look singular.");
  add_if(!ascent.has_converged, "A search that does not converge says nothing.");
  add_if(!levels.empty() && !levels.back().is_solved && !evidence.is_full,
         "The equations do not vanish at the point to round-off: their solutions may be singular "
         "there.");
  if (!ascent.has_point()) return result;
  add_if(!evidence.is_same_rank,
         "The ranks are higher at the point as it was found: they are lower only if it is "
         "elsewhere, within its error.");
  if (!is_singular && is_lower_where_given(consistent, ascent.jet, levels))
    result.emplace_back(
        Doubt::Kind::near_singular,
        "The ranks are lower at the given values, which had to move a little: these look singular, "
        "and the point that was found next to them does not.");
  add_if(is_singular && !has_clear_cuts(levels),
         "The ranks at the point are lower than nearby by numbers that are hardly below their "
         "errors.");
  add_if(!evidence.is_known && !evidence.is_full,
         "The derivatives of the equations are not known well enough at the point to say which of "
         "them vanish.");
  return result;
}

}  // namespace courant
