// Unknowns that nobody gave, where 0 will not do.
#pragma once

#include <optional>
#include <vector>

#include "courant/structures/implicit_system.hpp"
#include "courant/structures/state.hpp"

namespace courant {

// z of a guess at which F and ∂F/∂z are finite at its x, v and t: that of the guess if they are. Else its `open`
// entries are what equations without velocities give: each from an equation in which it is the only one that is open,
// by Newton's method from some places; then from those in which it was another one. So z of 1/z - x' = 0, z - x = 0 is
// x and not 0, where 1/z has no value, and P of Q - √P = 0, P - x = 0 is not 0 either, where √P has no derivative.
// Where derivatives alone are not finite, entries that no equation gives alone are tried at some places. Nothing where
// F has no value.
std::optional<VectorXd> defined_unknowns(const ImplicitSystem& system, const State& guess,
                                         std::vector<Index> open);

}  // namespace courant
