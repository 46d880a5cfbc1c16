// What of an experiment does not change along its solutions.
#pragma once

#include <string>
#include <vector>

#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/reading/experiment.hpp"

namespace courant {

// The greatest |d/dt| of a quantity along S_f at some points of M_f, next to the terms that it is the sum of.
struct MeasuredInvariant {
  std::string name;
  double rate = 0.0, scale = 0.0;
  bool is_invariant = false;
};

// Of the energy, the momenta of declared symmetries and the observables, as far as they are functions of x alone: at
// the ladder's point and at these states. Nothing where S_f is no vector field.
std::vector<MeasuredInvariant> measured_invariants(const Experiment& experiment,
                                                   const ConstraintLadder& ladder,
                                                   const std::vector<VectorXd>& states);

}  // namespace courant
