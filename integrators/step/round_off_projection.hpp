// Keeps points on their manifold at round-off level.
#pragma once

#include "courant/core/expressions/function.hpp"
#include "courant/manifolds/manifold.hpp"

namespace courant {

// One Gauss–Newton step onto {constraint(x) = 0} for an x that is on it up to accumulated
// round-off: x moves by as little as its defect, so a method is not changed by it, and the defect
// does not grow over 10⁶ steps. The gradients are made orthonormal by Gram and Schmidt, each the
// longest of what the earlier ones leave; programs in C repeat the loops, to the last bit. Nothing
// happens, and nothing is allocated, while the defect is below 32 eps max(1, ‖x‖²) = 7e-15 max(1,
// ‖x‖²): the round-off of some hundred steps. Holds workspace: one object a trajectory.
class RoundOffProjection {
 public:
  // x ↦ constraint(x), with its Jacobian to be traced once for all trajectories.
  static Function::Formulas formulas(const Manifold& manifold);
  static Function constraint(const Manifold& manifold, Backend backend);
  explicit RoundOffProjection(Function constraint);
  void apply(VectorXd& x);

 private:
  Function constraint_;
  VectorXd all_;        // the constraint and the entries of its Jacobian
  MatrixXd gradients_;  // a column each
};

}  // namespace courant
