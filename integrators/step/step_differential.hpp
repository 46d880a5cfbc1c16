// StepDifferential: the tangent map of a step.
#pragma once

#include "courant/integrators/step/step.hpp"

namespace courant {

// T_xΦ_h of a step that a method made, by the exact derivatives of the equations that the step solves: with
// F(x₀, y) = 0 and x₁ = G(x₀, y)
//
//   T_xΦ_h = ∂G/∂x₀ - ∂G/∂y (∂F/∂y)⁻¹ ∂F/∂x₀
//
// Evaluated at the Step, which is data: no step is made again. Its error is the round-off of one linear
// solve. The functions are traced when the object is made, so that who does not ask pays nothing.
// Immutable.
class StepDifferential {
 public:
  virtual ~StepDifferential() = default;

  // The images of the columns of V (N × k), ambient velocities that are tangent at step.before.x, to M_f
  // for a method on M_f: ambient velocities at step.after.x (N × k). Of a method that is made of several
  // steps, the step has to know its parts (Stepper::tell_parts). Throws std::invalid_argument otherwise,
  // and on wrong sizes; std::domain_error where the end of the step is not a function of its beginning.
  MatrixXd operator()(const Step& step, const MatrixXd& V) const;

  // The adjoint: covectors (T_xΦ_h)ᵀ Λ at step.before.x for the columns of Λ (N × m), covectors at step.after.x.
  // Covectors are ambient, and known where they are paired with vectors that have an image: ⟨pull_back(Λ), V⟩ = ⟨Λ,
  // images of V⟩. Costs one linear solve, but of methods that say otherwise where they define it. Throws as above.
  MatrixXd pull_back(const Step& step, const MatrixXd& Lambda) const;

 protected:
  // The same from the images of independent vectors V (N × k) which span all that have one.
  static MatrixXd pull_back_by(const MatrixXd& V, const MatrixXd& images, const MatrixXd& Lambda);

 private:
  // To subclass, override:
  virtual MatrixXd do_images(const Step& step, const MatrixXd& V) const = 0;
  virtual MatrixXd do_pull_back(const Step& step, const MatrixXd& Lambda) const = 0;
};

// X with A X + B = 0, where A (m × n) may be oblong or singular as redundant equations make it: the solution of least
// norm in the units of an Equilibration. Throws std::domain_error, beginning with `place`, if there is none up to 1e-6
// of the terms of a row and 1e-12 of all terms, or if it leaves the first `determined` unknowns free.
MatrixXd implicit_derivative(const char* place, const MatrixXd& A, const MatrixXd& B,
                             Index determined);
// W (m × k) with Wᵀ B = Cᵀ X for the X of the above, whatever B is that has such an X: the adjoint, by the transposed
// matrix. C: n × k.
MatrixXd implicit_adjoint(const char* place, const MatrixXd& A, const MatrixXd& C,
                          Index determined);

}  // namespace courant
