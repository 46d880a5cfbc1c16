#include "courant/integrators/certificate/ladder_ascent.hpp"

#include <algorithm>
#include <cmath>

#include "courant/core/words/text_layout.hpp"

namespace courant {
namespace {

// The equations that contradict each other at a point where Jᵀ F = 0: those that F, a left null
// vector, consists of.
std::vector<NamedEquation> contradicting(const ImplicitSystem& system, const Zero& zero) {
  const Index r = system.equation_count();
  const double largest =
      zero.scaled_value.size() == 0 ? 0.0 : zero.scaled_value.lpNorm<Eigen::Infinity>();
  std::vector<NamedEquation> found;
  for (Index i = 0; i < zero.scaled_value.size(); ++i)
    if (std::abs(zero.scaled_value[i]) >= 0.1 * largest)
      found.push_back({system.names().equations[static_cast<std::size_t>(i % r)], i / r});
  return found;
}

// The levels at the jet. Where they are doubtful the jet is found once more, and stays what was
// found if that helps.
std::vector<LadderLevel> levels_at(const ConsistentPoint& consistent, ConsistentJet& jet) {
  std::vector<LadderLevel> levels = levels_at(jet);
  if (are_certain(levels)) return levels;
  ConsistentJet other = consistent.again(jet);
  if (!other.zero().found) return levels;
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

}  // namespace

bool repeats(const std::vector<LadderLevel>& levels) {
  if (levels.size() < 2) return false;
  const LadderLevel& last = levels.back();
  const LadderLevel& before = levels[levels.size() - 2];
  return last.dim_S == before.dim_S && last.dim_M == before.dim_M;
}

std::string change(const std::vector<LadderLevel>& before, const std::vector<LadderLevel>& now) {
  for (std::size_t k = 0; k < std::min(before.size(), now.size()); ++k)
    if (before[k].dim_S != now[k].dim_S || before[k].dim_M != now[k].dim_M)
      return "Level " + std::to_string(k) + " has other dimensions at the point of level " +
             std::to_string(before.size() - 1) + " than at that of level " +
             std::to_string(now.size() - 1) + ".";
  return "";
}

LadderAscent::LadderAscent(const ConsistentPoint& consistent, const ImplicitSystem& system,
                           Index max_level)
    : jet(consistent.start()) {
  for (Index k = 0; k <= max_level && climb(consistent, system, k); ++k) {
  }
  // Levels that contradict each other at a point that looks singular from one side: so it is.
  if (!is_singular() && !singular.seen_once.empty() && !contradictions(levels).empty()) {
    singular.reason = std::move(singular.seen_once);
    singular.is_unanimous = false;
  }
}

// To level k; whether the way goes on.
bool LadderAscent::climb(const ConsistentPoint& consistent, const ImplicitSystem& system, Index k) {
  const ConsistentJet next = consistent.find(jet.at_level(k));
  if (!next.zero().is_finite) {
    reason = not_finite(system, next.array(), next.zero().y) +
             ": the algorithm stops before level " + std::to_string(k) + ".";
    return false;
  }
  if (!next.zero().found) {
    end_without_point(consistent, system, next, k);
    return false;
  }
  jet = next;
  std::vector<LadderLevel> found = levels_at(consistent, jet);
  if (changed.empty()) changed = change(levels, found);
  levels = std::move(found);
  if (!contradictions(levels).empty()) return false;
  is_stopped = repeats(levels);
  const std::string before = std::move(singular.seen_once);
  singular = singularity(consistent, jet, levels, is_stopped);
  if (singular.seen_once.empty()) singular.seen_once = before;
  return !is_singular() && !is_stopped;
}

// `ended`: where the search for a point of level k ended.
void LadderAscent::end_without_point(const ConsistentPoint& consistent,
                                     const ImplicitSystem& system, const ConsistentJet& ended,
                                     Index k) {
  // Where zeros of the last level are singular, those of this one need not be near.
  if (k > 0) {
    singular = singularity(consistent, jet, levels, true);
    if (is_singular()) return;
  }
  if (!consistent.is_contradiction(ended)) {
    has_converged = false;
    reason = "The search for a point of S" + subscript(k) +
             " did not converge, and the equations do not contradict each other where "
             "it ended.";
    return;
  }
  LadderLevel empty;
  empty.k = k;
  empty.is_empty = true;
  empty.residual = ended.array().residual(ended.zero().y).lpNorm<Eigen::Infinity>();
  levels.push_back(empty);
  contradiction = contradicting(system, ended.zero());
  reason = "No point of S" + subscript(k) +
           " was found near the given values: these equations contradict each other: " +
           in_words(contradiction) + ".";
  jet = ended;
}

}  // namespace courant
