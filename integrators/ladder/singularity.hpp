// Whether a point of a constraint set looks singular.
#pragma once

#include <string>
#include <vector>

#include "courant/integrators/ladder/consistent_point.hpp"
#include "courant/integrators/ladder/ladder_levels.hpp"
#include "courant/integrators/ladder/refined_array.hpp"

namespace courant {

// The levels at a point that was found.
std::vector<LadderLevel> levels_at(const ConsistentJet& jet);

// Whether none of their ranks is doubtful, and they do not contradict each other.
bool are_certain(const std::vector<LadderLevel>& levels);

// The array of the jet to 113 bits, if that has the ranks of the levels, none of them doubtful: what 53 bits leave
// open of this point may then be asked there.
std::optional<RefinedArray> refined_with(const ConsistentJet& at,
                                         const std::vector<LadderLevel>& levels);

// Says so of ranks that the bound of their errors proves with little to spare, and of which it leaves nothing
// open: those are not doubtful once points nearby have them too.
void confirm(std::vector<LadderLevel>& levels);
// No rank is doubtful any more: they are those that more digits give.
void settle(std::vector<LadderLevel>& levels);

// Whether all ranks are proven at the point, and are the largest that equations with entries where those around
// the point have some can have. Then they are constant around it, whatever points nearby may say, and numbers that
// were lost in their errors make none of them larger.
bool are_ranks_of_pattern(const ConsistentJet& at, const std::vector<LadderLevel>& levels);

// What is singular at a zero of the derivative array.
struct Singularity {
  std::string reason = "";     // in words; empty if nothing is
  std::string seen_once = "";  // the same, of one direction only
  bool is_unanimous = true;    // whether no direction says that nothing is
  bool is_compared = true;     // whether there were points nearby to compare with
  bool is_confirmed = false;   // whether enough of them have the same ranks, proven there too
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

// Whether each rank of the levels has a cut with nothing near it. Of a point that is said to be singular the
// ranks are lower than nearby by what was neglected: numbers near the bound of their error say that only if
// those that count are far from it.
bool has_clear_cuts(const std::vector<LadderLevel>& levels);

// Why solutions branch at a point.
struct Branching {
  std::string reason = "";   // in words; empty if nothing says so
  bool is_confirmed = true;  // whether the points next to it are zeros with 113 bits too
};

// Whether solutions branch at the point of a ladder that has an index.
// Where M_{k+1} has fewer dimensions than M_k, points of M_k next to it that its constraints leave out should
// have no velocity. If they have one, and it leads back to another velocity of the point along which the sets
// are larger, another curve leads through the point: as at the turning points of θ'²/2 = cos θ, where both rest
// and motion solve the equations. Up to 200 unknowns.
Branching branching(const ConsistentPoint& consistent, const ConsistentJet& at,
                    const ConstraintLadder& ladder);

}  // namespace courant
