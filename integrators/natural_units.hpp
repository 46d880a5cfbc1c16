// The sizes that are typical of a system's coordinates.
#pragma once

#include "courant/integrators/ladder/constraint_ladder.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

// What is a typical size of each of the Ñ numbers of a tangent vector of M, near the ladder's
// point: the units in which the ladder compared equations and unknowns, as NaturalScaling gives
// them. A change of units of the coordinates changes these sizes with them. Numbers that the
// tangent projector of M mixes, as those of a sphere, share a unit. All 1 where the ladder has no
// point.
VectorXd natural_units(const std::shared_ptr<const ImplicitSystem>& system,
                       const ConstraintLadder& ladder);

}  // namespace courant
