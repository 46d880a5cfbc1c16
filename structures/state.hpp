// State: where a trajectory is.
#pragma once

#include "courant/core/expr.hpp"

namespace courant {

// Where a trajectory is: x ∈ M at time t, with the tangent vector and the auxiliary unknowns of the
// last step there (v: Ñ, z: m; estimates of those at x, used to start the next iteration and to
// evaluate what depends on them).
struct State {
  double t = 0.0;
  VectorXd x = {};
  VectorXd v = {};
  VectorXd z = {};
};

}  // namespace courant
