// StageStep: the step of a method that evaluates a system once.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "courant/core/solve/equation_system.hpp"
#include "courant/integrators/maps/discretization_map.hpp"
#include "courant/integrators/step/step_differential.hpp"
#include "courant/integrators/step/step_formulas.hpp"
#include "courant/integrators/step/step_program.hpp"
#include "courant/integrators/step/stepper.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

// The equations of a step that evaluates a system at one point x̄ between x₀ and x₁, traced and
// compiled: what Method 1 and the methods of discrete gradients have in common.
//
// With a map that has a closed from_start the unknowns of a step are the coordinates ξ of a tangent
// vector at x₀ and z:
//   F(x̄, v / h, z, t̄) = 0,   (x̄, v, x₁) = from_start(x₀, B ξ), so that (x̄, v) = R_d⁻¹(x₀, x₁);
// otherwise (x̄, v, z), with R_d⁻(x̄, h v) = x₀ and then x₁ = R_d⁺(x̄, h v).
// Where redundant equations or undetermined z make the matrix singular or oblong, steps are solved
// by least squares. Immutable and cheap to copy.
class StageStep {
 public:
  // What F may depend on; h v is a tangent vector at x̄.
  struct Stage {
    ExprVector x, v, z;
    Expr t, h;
    ExprVector end;  // x₁
    Expr end_time;
  };
  // F, as many equations as the system has; the covector (Ñ) that stands in the place of dH, or nothing.
  struct Equations {
    ExprVector residual, effort = ExprVector(0);
  };
  using Method = std::function<Equations(const Stage&)>;

  // `map` on the manifold of `system`; `name` is that of the method, in messages.
  StageStep(std::string name, std::shared_ptr<const ImplicitSystem> system,
            std::shared_ptr<const DiscretizationMap> map, Method method, const Backend& with);

  const DiscretizationMap& map() const { return *map_; }
  bool is_native() const { return equations_.is_native(); }
  StepFormulas formulas() const;
  // As of Programmed.
  StepProgram program() const;
  std::unique_ptr<Stepper> stepper() const;
  // As of Integrator: of the equations at (x₀, x₁) where the map has an inverse, else at (x̄, v).
  std::shared_ptr<const StepDifferential> differential() const;

 private:
  class Differential;
  class Trajectory;
  struct Trace;

  std::string name_;
  std::shared_ptr<const ImplicitSystem> system_;
  std::shared_ptr<const DiscretizationMap> map_;
  Method method_;
  std::vector<Index> contained_;  // the coordinates of x₀ that the equations contain
  EquationSystem equations_;      // y; x₀, basis, h, t ↦ residual
  Function whole_;                // the same without elimination, unless it is affine
  Function advance_;          // the same ↦ x₁, v, x̄ unless the map has an inverse, the effort
  Function stage_;            // x₀, x₁ ↦ x̄ where it has
  Function basis_;            // of TransportedFrame
  Function constraint_;       // of RoundOffProjection
  Index tangent_blocks_ = 1;  // leading blocks of y that are coordinates of tangent vectors at x₀
  Index efforts_ = 0;         // numbers of the effort
};

}  // namespace courant
