// The findings of the constraint algorithm as JSON.
#pragma once

#include "courant/integrators/ladder/constraint_ladder.hpp"
#include "courant/reading/findings.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

// As `courant constraints --json` prints it and a summary has it. What there is not (the dimensions
// of a set that is empty, the index of a ladder that did not end) is null.
Json ladder_json(const ConstraintLadder& ladder, const ImplicitSystem& system);

// That of a DiscreteConstraintAlgorithm: verdict, levels, and the first point of the chain.
Json discrete_ladder_json(const ConstraintLadder& ladder, const ImplicitSystem& system);

// What of a ladder is known when the algorithm stops at this level; the ladder itself if it ends
// there or before.
Json up_to_level(Json ladder, Index level);

}  // namespace courant
