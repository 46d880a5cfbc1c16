// How the start of a run moves with the numbers that it is made of.
#pragma once

#include "courant/running/varied_system.hpp"

namespace courant {

// ∂(x₀, θ)/∂(each of `by`) along M_f, a column each ((N + p) × k): the derivative of the consistent start of the
// experiment by the number that is typed.
//
// A number that is typed for a start value moves that one; other values that are typed stay as they are, where their
// formulas do not contain the parameter that moves, and what is not given follows so that the point stays on M_f(θ):
//
//   δ ∈ T M_f,   δθ = e_j or 0,   δ(given value) = ∂(what is typed for it)
//
// Where this has exactly one solution it is that, to round-off. Where it leaves something open, or where the values
// that are given cannot all be kept (then those that are held are), it is what the start makes of it, in T M_f:
// measured by differences of order 8 of starts from other numbers, to about 1e-11.
//
// Throws ExperimentError at the name of a number that cannot be varied: the constraints and what is held leave it no
// other value, or there is no start from numbers nearby.
MatrixXd varied_start(const Experiment& experiment, const VariedSystem& system, const State& start);

}  // namespace courant
