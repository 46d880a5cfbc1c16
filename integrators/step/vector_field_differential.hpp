// The differential of a VectorField.
#pragma once

#include <utility>

#include "courant/integrators/step/vector_field.hpp"

namespace courant {

// x ↦ (ẋ, v, z) of a VectorField, differentiated through its equations: with G(y, x) = 0 and (ẋ, v, z) = r(y, x)
//
//   (dẋ, dv, dz) = (∂r/∂x - ∂r/∂y (∂G/∂y)⁺ ∂G/∂x) δx
//
// in a basis that turns with x as that of an Evaluation does. Off M_f it is that of the extension that
// VectorField is; on M_f, along T_xM_f, that of S_f. Immutable.
class VectorFieldDifferential {
 public:
  explicit VectorFieldDifferential(const VectorFieldFormulas& formulas);

  // Where an Evaluation was made last.
  struct Place {
    const VectorXd& x;
    double t;
    const VectorXd& unknowns;
    const LinearMap<double>& basis;
  };
  struct Images {
    MatrixXd rate, v, z;  // N × k, Ñ × k, m × k
  };
  // Of the columns of V (N × k). Throws std::domain_error where v is not determined by x.
  Images operator()(const Place& at, const MatrixXd& V) const;

  // T_xM_f in the basis B at the place, as orthonormal columns (n × dim M_f): the ξ for which the
  // equations of S_f can be kept by some change of y. `codimension` is that of M_f.
  MatrixXd constrained_directions(const Place& at, Index codimension) const {
    return split(at, codimension).first;
  }
  // The same, and its annihilator: orthonormal columns (n × codimension).
  std::pair<MatrixXd, MatrixXd> split(const Place& at, Index codimension) const;

 private:
  std::shared_ptr<const ImplicitSystem> system_;
  Function equations_, rate_, all_;  // y, x, basis, t ↦ each, with Jacobian by y and x
};

}  // namespace courant
