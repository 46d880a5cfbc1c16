// Whether a point of a constraint set looks singular.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "courant/integrators/certificate/consistent_point.hpp"
#include "courant/integrators/certificate/level_certainty.hpp"

namespace courant {

// What is singular at a zero of the derivative array.
struct Singularity {
  std::string reason = "";     // in words; empty if nothing is
  std::string seen_once = "";  // the same, of one direction only
  bool is_unanimous = true;    // whether no direction says that nothing is
  bool is_compared = true;     // whether there were points nearby to compare with
  bool is_confirmed = false;   // whether enough of them have the same ranks, proven there too
  // What has_refined_ranks() says of the point, if that was asked here.
  std::optional<bool> is_refined = std::nullopt;
};

// Zeros of constant rank form a manifold whose tangent space is the kernel of the Jacobian: a point at
// ε in a tangent direction has a zero within O(ε²), and the same ranks there. A neighbour can be
// misjudged where equations are strongly curved in its direction; a singular point looks singular
// from everywhere. So the majority decides, and a direction that says otherwise leaves a doubt. With
// `follow`, what the Jacobian does not see of the equations is examined too. Searches far from what
// vanishes are for small systems: they take a third of the time of a ladder of 25 rods.
Singularity singularity(const ConsistentPoint& consistent, const ConsistentJet& at,
                        const std::vector<LadderLevel>& levels, bool follow);

// Whether the ranks stay those of the levels if the point is taken for exact. Zeros are exact only at
// exact points, so that for levels that are not said to be `lowered` only those count that are not far
// below their bounds, and clearly numbers at the point.
bool is_same_rank_at(const ConsistentJet& at, const std::vector<LadderLevel>& levels, bool lowered);

// Whether the ranks are lower at the given values than at the point next to them that was found. So they
// are at the fold of x = y³/3 - y with x' = y, where no solution is: the search ends at 10⁻⁶ of it,
// where there is one with a velocity of 10⁵.
bool is_lower_where_given(const ConsistentPoint& consistent, const ConsistentJet& at,
                          const std::vector<LadderLevel>& levels);

}  // namespace courant
