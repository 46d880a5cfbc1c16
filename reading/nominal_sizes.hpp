// NominalSizes: how large coordinates and unknowns are said to be.
#pragma once

#include <Eigen/Core>

namespace courant {

using Eigen::VectorXd;

// Sizes that norms measure by, 0 where none is given: the weights of steps, and what it costs to move a value that is
// not consistent. No decision knows them.
struct NominalSizes {
  VectorXd coordinates = {};  // N
  VectorXd unknowns = {};     // m, where unknowns have names

  bool any() const { return (coordinates.array() > 0.0).any() || (unknowns.array() > 0.0).any(); }
};

}  // namespace courant
