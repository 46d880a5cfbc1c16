// The findings of the constraint algorithm as JSON.
#pragma once

#include "courant/integrators/ladder/constraint_ladder.hpp"
#include "courant/reading/findings.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

// As `courant constraints --json` prints it and a summary has it. What there is not (the dimensions
// of a set that is empty, the index of a ladder that did not end) is null.
Json ladder_json(const ConstraintLadder& ladder, const ImplicitSystem& system);

}  // namespace courant
