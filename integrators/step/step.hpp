// Step: what is known of a step.
#pragma once

#include <vector>

#include "courant/structures/state.hpp"

namespace courant {

// What a step knows.
struct Step {
  double h = 0.0;
  State before = {}, after = {};
  // (x̄, v, z) at time t̄: where the system was evaluated to make the step; of several such points
  // the last.
  State stage = {};
  // The covector (Ñ) that stands in the place of dH(x̄): a discrete gradient. Empty: dH(x̄) itself.
  VectorXd effort = {};
  // Those that it was made of, one after the other, if there are several, as of a Composition: empty
  // ones unless Stepper::tell_parts() was called before the step.
  std::vector<Step> parts = {};
  // By how much h of a TransformedIntegrator advances the time, next to h.
  double rate = 1.0;

  // By how much the time advances.
  double duration() const { return rate * h; }
};

// What the steps of a motion were like. A step that begins without those before it takes its solution
// for that along the motion if this says so.
struct Motion {
  bool is_predictable = false;  // the last step was predicted by those before
  VectorXd displacements = {};  // sizes of those of the last steps, in the coordinates of a step
};

}  // namespace courant
