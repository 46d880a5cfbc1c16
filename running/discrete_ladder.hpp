// The constraint algorithm of the steps of an experiment's method.
#pragma once

#include "courant/reading/experiment.hpp"
#include "courant/running/consistent_start.hpp"
#include "courant/running/ladder_report.hpp"

namespace courant {

// Remark 6.1 on the system, the discretization map and the step of an experiment: from which points steps can be made,
// pairs of points in place of velocities. `start` is that of the experiment. Throws ExperimentError where it has no
// method, no step, or a method without a discretization map.
LadderReport discrete_ladder(const Experiment& experiment, const ConstraintLadder& start);

}  // namespace courant
