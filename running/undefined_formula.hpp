// Which formula of an experiment has no value at a state.
#pragma once

#include <string>

#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/reading/experiment.hpp"

namespace courant {

// In words, the first equation, energy or observable that has no value at the state, and the
// function in it that has none:
//
//   sqrt(x - 2) in the equation "x' - sqrt(x-2)" has no value <where>: the argument of sqrt is -1,
//   expected at least 0
//
// Empty if all of them have one.
std::string undefined_formula(const Experiment& experiment, const State& state,
                              const std::string& where);

// The name of an equation in a sentence: the equation "x' - y", equation 2 where it has no name.
std::string equation_in_words(const ImplicitSystem& system, Index equation);

// The same as undefined_formula for the equations at the states to which the velocity leads within
// two steps of size h: why a step could not be solved.
std::string undefined_ahead(const Experiment& experiment, const ConstraintLadder& ladder,
                            const State& state, double h);

// Why a step of Method 2 may have failed that `message` tells of, as words to go on with: the first
// equation with a corner, where the derivatives of constraints that the method solves jump. Empty for other
// methods, without constraints, and where no equation has one.
std::string corner_in_words(const std::string& message, const ImplicitSystem& system,
                            const ConstraintLadder& ladder);

// Why no solution may be connected to a state, as words to go on with: the first equation that has a condition on t. Empty
// where none has.
std::string condition_on_time_in_words(const ImplicitSystem& system);

}  // namespace courant
