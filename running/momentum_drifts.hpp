// How well a method keeps the momenta of symmetries.
#pragma once

#include <optional>

#include "courant/integrators/step/integrator.hpp"
#include "courant/reading/experiment.hpp"

namespace courant {

// How far the method takes the momentum of each declared symmetry from its value at the state in 20 steps of the
// experiment, next to the terms it is the sum of. One that the method keeps changes by what its equations are
// solved to, 1e-14 or so of its terms a step; one that it does not keep by its truncation error. No value if a step
// fails.
std::optional<VectorXd> momentum_drifts(const Experiment& experiment, const Integrator& integrator,
                                        State state);

}  // namespace courant
