// From the initial values of an experiment to a consistent point.
#pragma once

#include "courant/integrators/certificate/certificate.hpp"
#include "courant/running/impulsive_start.hpp"

namespace courant {

// Runs the constraint algorithm at the initial values: what is not given is found, what is given is
// kept when it can be, then unknowns give way, then the start is the nearest (start_stages); what is held is kept
// in any case, to the bit. `decider`: what ranks are decided by.
//
// Throws ExperimentError where the equations are not finite at the initial values, where held
// values contradict the constraints, and where a value is missing that nothing determines. An
// inconsistent system is a finding: its ladder says so.
ConsistentStart consistent_start(const Experiment& experiment, Decider decider = Decider::both);

}  // namespace courant
