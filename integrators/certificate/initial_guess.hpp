// InitialGuess: what is known of a start.
#pragma once

#include <vector>

#include "courant/core/expressions/expr.hpp"

namespace courant {

// What is known at the start. Values are the nearest consistent ones unless they are held.
struct InitialGuess {
  double t = 0.0;
  VectorXd x;               // N
  VectorXd v = VectorXd();  // Ñ, or empty: unknown
  VectorXd z = VectorXd();  // m, or empty: unknown but for what v says of it
  // Components of x, v, z that must keep their values.
  std::vector<Index> hold_x = {}, hold_v = {}, hold_z = {};
};

}  // namespace courant
