// The system of a run that is differentiated by parameters.
#pragma once

#include <memory>
#include <optional>

#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/integrators/step/step.hpp"
#include "courant/integrators/step/vector_field.hpp"
#include "courant/integrators/step/vector_field_differential.hpp"
#include "courant/reading/experiment.hpp"
#include "courant/structures/parameter_extension.hpp"

namespace courant {

// S with the p parameters that are varied as coordinates (ParameterExtension), near the start of a run; S itself where
// p = 0. Points are (x, θ). Immutable.
class VariedSystem {
 public:
  // `ladder`: of the experiment, at its start. Throws ExperimentError at /sensitivities where the system is not
  // regular, and at the name of a parameter that cannot be varied: where an experiment with another number there has
  // other sizes, other times or no meaning; where equations, energy or space take the number when they are read, so
  // that their derivative by it is not known; where near it the certificate is another one.
  VariedSystem(const Experiment& experiment, const ConstraintLadder& ladder);

  Index count() const { return extension_ ? extension_->count() : 0; }  // p
  const std::shared_ptr<const ImplicitSystem>& system() const { return system_; }
  const ConstraintLadder& ladder() const { return ladder_; }  // of it
  const ParameterExtension* extension() const { return extension_ ? &*extension_ : nullptr; }
  State extended(const State& state) const;
  Step extended(const Step& step) const;

  // T_xM_f as orthonormal ambient velocities ((N + p) × k).
  MatrixXd directions(const State& at) const;
  // (ẋ, v, z) as S_f has them at an extended state, and their changes along the columns of V.
  struct Rates {
    VectorXd v, z;
    VectorFieldDifferential::Images changes;
  };
  Rates rates(const State& at, const MatrixXd& V) const;

 private:
  struct Field {
    VectorField field;
    VectorFieldDifferential differential;
  };
  std::optional<ParameterExtension> extension_;
  std::shared_ptr<const ImplicitSystem> system_;
  ConstraintLadder ladder_;
  std::shared_ptr<const Field> field_;
};

// The experiment with another number in the place of one that is varied: read again for a parameter. Throws
// ExperimentError as reading does.
Experiment with_number(const Experiment& experiment, const Sensitivities::Variable& variable,
                       double value);

}  // namespace courant
