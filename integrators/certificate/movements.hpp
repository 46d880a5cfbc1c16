// What had to move to be consistent.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/integrators/certificate/initial_guess.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

// The numbers of a guess that are others at a point, but for rounding, by name: coordinates, velocities, unknowns.
// Velocities that are not those of coordinates are v[0], v[1], …
std::vector<Movement> movements(const ImplicitSystem& system, const InitialGuess& guess,
                                const State& point);

// Of numbers of one kind: those that are others than what was given, by their names; an empty name is left out. What is
// round-off next to the largest of them is 0.
void add_movements(const VectorXd& given, const VectorXd& found,
                   const std::function<std::string(Index)>& name, std::vector<Movement>& moves);

}  // namespace courant
