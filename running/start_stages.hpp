// What a start is to be near to, first things first.
#pragma once

#include <vector>

#include "courant/integrators/certificate/nearest_start.hpp"
#include "courant/reading/experiment.hpp"

namespace courant {

// The given values of an experiment as the stages of a NearestStart:
//
//   1. positions: on T*Q those of Q, elsewhere all coordinates, with the weights that are given, else 1;
//   2. velocities, in g, and on T*Q momenta, in g⁻¹, of the kinetic energy ½ g(v, v) at the positions that were found;
//      with the weights of momenta if some are given, else, where there is no kinetic energy, 1;
//   3. unknowns.
//
// `guess`: the given values as what the constraint algorithm takes.
std::vector<NearestStart::Stage> start_stages(const Experiment& experiment,
                                              const InitialGuess& guess);

}  // namespace courant
