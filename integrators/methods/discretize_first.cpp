#include "courant/integrators/methods/discretize_first.hpp"

#include "courant/integrators/step/stage_step.hpp"

namespace courant {

DiscretizeFirst::DiscretizeFirst(std::shared_ptr<const ImplicitSystem> system,
                                 std::shared_ptr<const DiscretizationMap> map,
                                 const Options& options)
    : Integrator(std::move(system)),
      step_(std::make_shared<const StageStep>(
          name(), this->system(), std::move(map),
          [S = this->system()](const StageStep::Stage& at) {
            return StageStep::Equations{S->residual(at.x, at.v, at.z, at.t)};
          },
          options.backend)) {}

int DiscretizeFirst::order() const { return step_->map().order(); }

bool DiscretizeFirst::is_symmetric() const { return step_->map().is_symmetric(); }

std::optional<bool> DiscretizeFirst::is_symplectic() const {
  if (step_->map().is_symplectic().value_or(false) && system()->is_lagrangian().value_or(false))
    return true;
  return std::nullopt;
}

bool DiscretizeFirst::is_native() const { return step_->is_native(); }

StepProgram DiscretizeFirst::program() const { return step_->program(); }

std::unique_ptr<Stepper> DiscretizeFirst::do_stepper() const { return step_->stepper(); }

std::vector<StepFormulas> DiscretizeFirst::do_formulas() const { return {step_->formulas()}; }

std::shared_ptr<const StepDifferential> DiscretizeFirst::do_differential() const {
  return step_->differential();
}

}  // namespace courant
