// The derivatives of what a run measures by parameters and initial values.
#pragma once

#include <memory>
#include <optional>

#include "courant/core/expressions/function.hpp"
#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/integrators/step/step_differential.hpp"
#include "courant/integrators/step/vector_field.hpp"
#include "courant/reading/experiment.hpp"
#include "courant/structures/parameter_extension.hpp"

namespace courant {

class VectorFieldDifferential;

// dx_k = T(Φ_h)^k δx₀ for the start's directions δx₀, a column for each parameter and initial value that the experiment
// differentiates by, and with it the derivatives of its quantities: exact derivatives of the steps that the run
// makes (StepDifferential, of the system with its parameters as coordinates: ParameterExtension).
//
// δx₀ lies in the tangent space of M_f, of the extended system where M_f moves with a parameter. What is given at the start
// changes as it is asked to: an initial value that is differentiated by with slope 1, the others by what their formulas
// say of the parameter. Where constraints tie given values together the change comes as near to that as M_f allows, by
// the stages and in the metrics of the start itself (start_stages). What is not given changes as little as possible.
//
// The time is fixed: steps have the times that they have. One object a trajectory.
class SensitivitiesOfRun {
 public:
  // From the first state on.
  void begin() { memory_.images = parts_->start; }
  // The next step, which knows its parts. Throws as StepDifferential does.
  void advance(const Step& step);
  // The columns of Sensitivities, at the state that the last step led to. Throws std::domain_error where a velocity that
  // they need is not determined.
  VectorXd derivatives(const State& state) const;

  struct Memory {
    MatrixXd images;  // (N + p) × the number of what is differentiated by
  };
  const Memory& memory() const { return memory_; }
  // Goes on from there. Throws std::invalid_argument if it is of another experiment.
  void recall(const Memory& memory);

  struct Parts {
    std::shared_ptr<const ParameterExtension> extension;  // null without parameters
    std::shared_ptr<const StepDifferential> differential;
    MatrixXd start;
    Function quantities;  // x, θ, v, z, t, with Jacobian by all but t
    // Of the system, extended or not, where the quantities depend on v or z.
    std::shared_ptr<const VectorField> field = {};
    std::shared_ptr<const VectorFieldDifferential> field_differential = {};
  };
  explicit SensitivitiesOfRun(std::shared_ptr<const Parts> parts);

 private:
  std::shared_ptr<const Parts> parts_;
  Memory memory_;
};

// Nothing unless the experiment asks for sensitivities. Throws ExperimentError where they cannot be had, and unless the
// derivative of the first step agrees with those of experiments in which the parameter or the initial value is a little
// more and less: a parameter that is made a number before equations are traced is found out so.
std::optional<SensitivitiesOfRun> sensitivities_of_run(const Experiment& experiment,
                                                       const ConstraintLadder& ladder,
                                                       const PreparedMethod& method);

}  // namespace courant
