// The initial values of an experiment as what the constraint algorithm begins with.
#pragma once

#include <string>

#include "courant/core/expressions/linear_map.hpp"
#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/reading/experiment.hpp"

namespace courant {

// Of messages: what was not given begins at 0, where there is such.
std::string with_zeros(const Experiment& experiment);

// The manifold, of which a point is near the initial values. Throws ExperimentError where there is none.
const Manifold& manifold_near_start(const Experiment& experiment);

// The initial values, with velocities as components by the coframe at them. Unknowns that were given nothing are 0;
// where these divide, or are under a root, elsewhere. Throws ExperimentError where an equation is not finite there.
InitialGuess first_guess(const Experiment& experiment, const LinearMap<double>& coframe);

}  // namespace courant
