// ConormalTurning: how the conormals of M_f turn along it.
#pragma once

#include "courant/integrators/step/vector_field_differential.hpp"

namespace courant {

// On a space whose tangent vectors are dx/dt themselves, let α = λᵀ∂F/∂x annihilate T_xM_f, where F(y, x) = 0 are the
// equations of S_f and M_f and λᵀ∂F/∂y = 0. Along δx ∈ T_xM_f, with δy such that F stays 0, and G = λᵀF:
//
//   (∂F/∂y)ᵀ δλ = -(∂²G/∂y² δy + ∂²G/∂y∂x δx),   δα = ∂²G/∂x² δx + ∂²G/∂x∂y δy + (∂F/∂x)ᵀ δλ
//
// up to conormals, of which λ may take up any. Exact to round-off: one Hessian of one function, whatever the dimension
// is. Immutable.
class ConormalTurning {
 public:
  // Throws std::invalid_argument where the basis of tangent vectors is a variable of the formulas: on curved spaces.
  explicit ConormalTurning(const VectorFieldFormulas& formulas);

  // δα for α (N) and each column of directions (N × k).
  MatrixXd operator()(const VectorFieldDifferential::Place& at, const VectorXd& alpha,
                      const MatrixXd& directions) const;

 private:
  Function equations_;  // y, x, t ↦ F, with Jacobian by y and x
  Function slopes_;     // λ, y, x, t ↦ ∂G/∂(y, x), with Jacobian by y and x
};

}  // namespace courant
