// What stops a run, in words for its user.
#pragma once

#include <string>

#include "courant/integrators/step/solve_error.hpp"
#include "courant/running/observer.hpp"

namespace courant {

// What a step from `state` says that failed, and which formula has no value where it was to lead, or has a
// corner that the method cannot go over.
std::string failure_in_words(const SolveError& error, const Experiment& experiment,
                             const ConstraintLadder& ladder, const State& state);

// Throws ExperimentError at /initial unless all that is written of the initial state is finite.
void require_finite(Observer& observer, const Experiment& experiment, const State& initial);

}  // namespace courant
