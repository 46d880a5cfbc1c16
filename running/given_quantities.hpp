// Starts with values of quantities that are no coordinates.
#pragma once

#include <vector>

#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/reading/experiment.hpp"

namespace courant {

// The initial values of an experiment with what its given quantities say of coordinates: those that the equations
// and the quantities move, from what is given, least, are given too; they are held where the
// quantities are. Throws ExperimentError, at the quantity, where no such values are found.
InitialValues with_quantities(const Experiment& experiment);

// The quantities that have other values at a point than those that were given: from these to those.
std::vector<Movement> moved_quantities(const Experiment& experiment, const State& point);

}  // namespace courant
