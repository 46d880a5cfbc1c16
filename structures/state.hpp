// State: where a trajectory is.
#pragma once

#include "courant/core/expressions/expr.hpp"

namespace courant {

// Where a trajectory is: x ∈ M at time t, with a tangent vector and auxiliary unknowns there (v: Ñ,
// z: m). v and z are what the last step knows of them; the next step starts its iteration from
// them, and they say which solution is meant where several are possible. Both may be empty: zero.
struct State {
  double t = 0.0;
  VectorXd x = {};
  VectorXd v = {};
  VectorXd z = {};
  // What a method carries from step to step besides: the momentum of time, see TimeTransformation.
  // Mostly empty.
  VectorXd carried = {};

  void swap(State& other);
  // *this = other, quicker for states of a few numbers.
  void take(const State& other);
};

// Whether all numbers are the same, bit by bit.
bool operator==(const State& a, const State& b);

// Whether all of x, v, z and what is carried are finite.
bool is_finite(const State& state);

}  // namespace courant
