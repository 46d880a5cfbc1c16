// State and Step: where a trajectory is, and what is known of its last step.
#pragma once

#include "courant/core/expr.hpp"

namespace courant {

// Where a trajectory is: x ∈ M at time t, with a tangent vector and auxiliary unknowns there (v: Ñ,
// z: m). v and z are what the last step knows of them; the next step starts its iteration from
// them, and they say which solution is meant where several are possible. Both may be empty: zero.
struct State {
  double t = 0.0;
  VectorXd x = {};
  VectorXd v = {};
  VectorXd z = {};

  void swap(State& other);
};

// Whether all numbers are the same, bit by bit.
bool operator==(const State& a, const State& b);

// What a step knows.
struct Step {
  double h = 0.0;
  State before = {}, after = {};
  // (x̄, v, z) at time t̄: where the system was evaluated to make the step; of several such points
  // the last.
  State stage = {};

  void swap(Step& other);
};

}  // namespace courant
