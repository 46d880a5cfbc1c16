// Step: what is known of a step.
#pragma once

#include "courant/structures/state.hpp"

namespace courant {

// What a step knows.
struct Step {
  double h = 0.0;
  State before = {}, after = {};
  // (x̄, v, z) at time t̄: where the system was evaluated to make the step; of several such points
  // the last.
  State stage = {};
};

}  // namespace courant
