#include "courant/integrators/certificate/bifurcation.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "courant/core/words/text_layout.hpp"
#include "courant/integrators/certificate/level_certainty.hpp"

namespace courant {
namespace {

bool is_larger(const std::vector<LadderLevel>& there, const std::vector<LadderLevel>& here) {
  for (std::size_t k = 0; k < std::min(there.size(), here.size()); ++k)
    if (there[k].dim_M > here[k].dim_M) return true;
  return false;
}

// Points of M_k next to the point of a ladder, where M_{k+1} leaves some of them out.
class PointsLeftOut {
 public:
  PointsLeftOut(const ConsistentPoint& consistent, const ConsistentJet& at,
                const ConstraintLadder& ladder, Index level)
      : consistent_(consistent),
        at_(at),
        ladder_(ladder),
        level_(level),
        here_(at.zero().y.head(at.array().base_size())) {}

  // Whether those in two directions lead back to another velocity of the point: no value if they do not,
  // else whether they are zeros with 113 bits too.
  std::optional<bool> lead_back() const {
    constexpr int directions = 4, needed = 2;
    const ConsistentJet lower = at_.at_level(level_);
    TangentDisplacement tangents(lower.array(), lower.zero().y, lower.zero().nominal);
    int met = 0;
    bool is_confirmed = true;
    for (int direction = 0; direction < directions && met < needed; ++direction) {
      ConsistentJet near =
          consistent_.find_displaced(lower, 1e-3 * tangents.next(), tangents.magnitude()).jet;
      if (!near.zero().found || !is_across(near.zero().y)) continue;
      const std::optional<bool> is_zero = leads_back(std::move(near));
      if (!is_zero) return std::nullopt;
      is_confirmed = is_confirmed && *is_zero;
      ++met;
    }
    return met < needed ? std::nullopt : std::optional(is_confirmed);
  }

 private:
  // Whether constraints of M_{k+1} leave the point of the jet out.
  bool is_across(const VectorXd& y) const {
    constexpr double away = 0.05;  // of a displacement: its part across M_{k+1}
    const VectorXd moved = at_.array().basis() * (y.head(here_.size()) - here_);
    return std::ranges::any_of(ladder_.constraints, [&](const PointConstraint& constraint) {
      return constraint.level == level_ + 1 &&
             std::fabs(constraint.gradient.dot(moved)) >
                 away * constraint.gradient.cwiseAbs().dot(moved.cwiseAbs());
    });
  }

  std::optional<bool> leads_back(ConsistentJet near) const {
    const Index n = here_.size(), top = at_.level();
    for (Index above = level_ + 1; near.zero().found && above <= std::min(level_ + 2, top);
         ++above) {
      near = near.at_level(above);
      near = consistent_.find_at(near, near.zero().y.head(n));
    }
    if (!near.zero().found) return std::nullopt;
    // Errors may hide that a point across has no velocity: with more digits the zero moves back, or is none.
    const std::optional<RefinedArray> refined = RefinedArray::at(near.array(), near.zero());
    if (refined && !is_across(near.zero().y + refined->correction())) return std::nullopt;
    const ConsistentJet back = consistent_.find_at(near, here_);
    if (!back.zero().found) return std::nullopt;
    const std::vector<LadderLevel> there = levels_at(back);
    if (!are_certain(there) || !is_larger(there, ladder_.levels)) return std::nullopt;
    return refined.has_value();
  }

  const ConsistentPoint& consistent_;
  const ConsistentJet& at_;
  const ConstraintLadder& ladder_;
  Index level_;
  VectorXd here_;
};

}  // namespace

Bifurcation bifurcation(const ConsistentPoint& consistent, const ConsistentJet& at,
                        const ConstraintLadder& ladder) {
  constexpr Index dense_limit = 200;
  const std::vector<LadderLevel>& levels = ladder.levels;
  if (at.array().has_constant_jacobian() || at.zero().y.size() > dense_limit) return {};
  for (std::size_t k = 0; k + 1 < levels.size(); ++k) {
    if (levels[k + 1].is_empty || levels[k + 1].dim_M >= levels[k].dim_M) continue;
    const PointsLeftOut points(consistent, at, ladder, static_cast<Index>(k));
    const std::optional<bool> is_confirmed = points.lead_back();
    if (!is_confirmed) continue;
    return {.reason = "Solutions branch here: M" + subscript(static_cast<Index>(k) + 1) +
                      " has dimension " + std::to_string(levels[k + 1].dim_M) +
                      " along the velocity of the point, and more along another one.",
            .is_confirmed = *is_confirmed};
  }
  return {};
}

}  // namespace courant
