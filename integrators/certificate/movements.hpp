// What had to move to be consistent.
#pragma once

#include <vector>

#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/integrators/certificate/initial_guess.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

// The numbers of a guess that are others at a point, but for rounding, by name: coordinates, velocities, unknowns.
// Velocities that are not those of coordinates are v[0], v[1], …
std::vector<Movement> movements(const ImplicitSystem& system, const InitialGuess& guess,
                                const State& point);

}  // namespace courant
