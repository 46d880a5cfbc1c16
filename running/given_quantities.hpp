// Starts with values of quantities that are no coordinates.
#pragma once

#include <vector>

#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/reading/experiment.hpp"

namespace courant {

// The initial values of an experiment with what its given quantities say of coordinates.
//
// 1. Quantities of coordinates alone that are as many as the coordinates in them determine these by their own
//    definitions, whatever the equations say: v_C = q/C gives q. They are given, as if they had been typed, and held
//    where the quantity is; of contradictory ones those that are held come first.
// 2. Coordinates that the equations and the other quantities move, from what is given, least, are given too; they are
//    held where one of these quantities is.
//
// Throws ExperimentError, at the quantity, where the equations have no value on the way.
InitialValues with_quantities(const Experiment& experiment);

// The quantities that have other values at a point than those that were given: from these to those.
std::vector<Movement> moved_quantities(const Experiment& experiment, const State& point);

}  // namespace courant
