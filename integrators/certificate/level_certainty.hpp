// How certain the levels of a ladder are at a point.
#pragma once

#include <optional>
#include <vector>

#include "courant/integrators/certificate/consistent_point.hpp"
#include "courant/integrators/certificate/ladder_levels.hpp"
#include "courant/integrators/certificate/refined_array.hpp"

namespace courant {

// The levels at a point that was found.
std::vector<LadderLevel> levels_at(const ConsistentJet& jet);

// Whether none of their ranks is doubtful, and they do not contradict each other.
bool are_certain(const std::vector<LadderLevel>& levels);

// The array of the jet to 113 bits, if that has the ranks of the levels, none of them doubtful: what 53 bits leave
// open of this point may then be asked there.
std::optional<RefinedArray> refined_with(const ConsistentJet& at,
                                         const std::vector<LadderLevel>& levels);

// Whether there is such an array.
bool has_refined_ranks(const ConsistentJet& at, const std::vector<LadderLevel>& levels);

// Whether the bounds of errors prove all ranks, and leave nothing open of them.
bool are_proven(const std::vector<LadderLevel>& levels);

// Says so of ranks that the bound of their errors proves with little to spare, and of which it leaves nothing
// open: those are not doubtful once points nearby have them too.
void confirm(std::vector<LadderLevel>& levels);
// No rank is doubtful any more: they are those that more digits give.
void settle(std::vector<LadderLevel>& levels);

// Whether all ranks are proven at the point, and are the largest that equations with entries where those around
// the point have some can have. Then they are constant around it, whatever points nearby may say, and numbers that
// were lost in their errors make none of them larger.
bool are_ranks_of_pattern(const ConsistentJet& at, const std::vector<LadderLevel>& levels);

// Whether each rank of the levels has a cut with nothing near it. Of a point that is said to be singular the
// ranks are lower than nearby by what was neglected: numbers near the bound of their error say that only if
// those that count are far from it.
bool has_clear_cuts(const std::vector<LadderLevel>& levels);

}  // namespace courant
