// Unknowns that equations give one by one.
#pragma once

#include <vector>

#include "courant/structures/implicit_system.hpp"
#include "courant/structures/state.hpp"

namespace courant {

// z of a guess, with the values of its `open` entries that equations without velocities give at x and t: each from an equation
// in which it is the only one that is open, by Newton's method from some places; then from those in which it was
// another one. What no equation gives stays. So z of 1/z - x' = 0, z - x = 0 is x and not 0, where 1/z has no value.
VectorXd solved_unknowns(const ImplicitSystem& system, const State& guess, std::vector<Index> open);

}  // namespace courant
