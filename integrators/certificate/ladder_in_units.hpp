// Ladders in other units.
#pragma once

#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/structures/system_in_units.hpp"

namespace courant {

// The ladder of a SystemInUnits as one of the system itself: its point, jet, moves, gradients and
// combinations. `moved` and the residuals of levels stay as they are.
ConstraintLadder restored(ConstraintLadder measured, const SystemInUnits& system);
// The ladder of the system itself as one in these units: what it decided stays.
ConstraintLadder measured(ConstraintLadder ladder, const SystemInUnits& system);

// Whether verdict, index and the dimensions of all levels are the same.
bool are_alike(const ConstraintLadder& a, const ConstraintLadder& b);

}  // namespace courant
