// ConsistentPoints: M_f as the space that nodes of a motion move in.
#pragma once

#include <memory>
#include <optional>

#include "courant/core/expressions/function.hpp"
#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/integrators/step/integrator.hpp"
#include "courant/integrators/step/vector_field.hpp"
#include "courant/integrators/step/vector_field_differential.hpp"

namespace courant {

// M_f of a regular system near the point of its ladder, by tangent spaces and a retraction:
//
//   directions(x)   an orthonormal basis of T_xM_f (N × k, ambient)
//   moved(x, w)     P(R_x(C(x) w)) for w ∈ T_xM_f, with the projection P of Method 2; unknowns are followed on the way
//   way(x, y)       y - x; where frames are the identity the shortest one, modulo 2π for angles
//
// Immutable.
class ConsistentPoints {
 public:
  // Throws std::invalid_argument unless the ladder is regular.
  ConsistentPoints(std::shared_ptr<const ImplicitSystem> system, const ConstraintLadder& ladder);

  Index dimension() const { return dimension_; }  // k
  MatrixXd directions(const State& at) const;
  State moved(const State& from, const VectorXd& w) const;
  // The nearest consistent point, with its velocity and unknowns, near those of the state. Throws std::domain_error
  // where the energy is not finite: equations may have solutions where what they are the derivative of has no value, as
  // beyond the barrier log(1 - u²) of a control.
  State nearest(const State& state) const;
  void require_energy(const State& at) const;
  VectorXd way(const VectorXd& from, const VectorXd& to) const;

  // (v, z) as S_f has them, and their changes along the columns of V.
  struct Rates {
    VectorXd v, z;
    MatrixXd dv, dz;
  };
  Rates rates(const State& at, const MatrixXd& V) const;

 private:
  std::shared_ptr<const ImplicitSystem> system_;
  Index dimension_, codimension_;
  VectorField field_;
  VectorFieldDifferential differential_;
  std::shared_ptr<const Integrator> projection_;  // null without constraints
  Function energy_;                               // of x, z, t; empty where there is none
};

}  // namespace courant
