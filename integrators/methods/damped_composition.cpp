#include "courant/integrators/methods/damped_composition.hpp"

#include <stdexcept>
#include <utility>

#include "courant/integrators/methods/composed_differential.hpp"
#include "courant/integrators/step/step_parts.hpp"

namespace courant {

// Each of the two has a stepper of its own, which sees equal steps along a smooth curve.
class DampedComposition::Trajectory final : public Stepper {
 public:
  using Integrators = std::array<std::shared_ptr<const Integrator>, 2>;

  Trajectory(const Integrators& integrators, const std::string& name)
      : Stepper(name, integrators[0]->system()),
        integrators_(integrators),
        steppers_{integrators[0]->stepper(), integrators[1]->stepper()} {}

 private:
  void do_prepare(State& state, double h) override { steppers_[0]->prepare(state, kParts[0] * h); }

  void do_step(const State& before, double h, State& after) override {
    const double end = after.t;
    after = before;
    advance(0, after, h, before.t + kParts[0] * h);
    advance(1, after, h, end);
  }

  void advance(std::size_t i, State& state, double h, double end) {
    const CountedWork counted(statistics_, *steppers_[i]);
    steppers_[i]->step_from(*steppers_[1 - i], state, kParts[i] * h, end);
  }

  void do_keep(const State&, const State&) override { parts_.keep(steppers_, tells_parts()); }
  void do_stage(Step& step) const override { parts_.tell(step); }
  void do_discard() override { do_forget(); }
  void do_forget() override {
    for (const auto& stepper : steppers_) stepper->forget();
  }
  std::unique_ptr<Stepper> do_fresh() const override {
    return std::make_unique<Trajectory>(integrators_, method());
  }

  Integrators integrators_;
  std::array<std::unique_ptr<Stepper>, 2> steppers_;
  StepParts parts_;
};

DampedComposition::DampedComposition(std::shared_ptr<const Integrator> first,
                                     std::shared_ptr<const Integrator> second)
    : Integrator(first ? first->system() : nullptr), steps_{std::move(first), std::move(second)} {
  if (!steps_[1] || steps_[1]->system() != system() || steps_[0]->order() != 1 ||
      steps_[1]->order() != 1)
    throw std::invalid_argument(
        "DampedComposition::DampedComposition: the second step is missing, or of another system, "
        "or one of the two is not of order 1; expected the same method with theta = sqrt(2) - 1 "
        "and "
        "theta = 1.");
}

std::string DampedComposition::name() const { return steps_[1]->name() + ", damped"; }

std::vector<StepFormulas> DampedComposition::do_formulas() const {
  std::vector<StepFormulas> formulas = steps_[0]->formulas();
  for (StepFormulas& of_second : steps_[1]->formulas()) formulas.push_back(std::move(of_second));
  return formulas;
}

std::shared_ptr<const StepDifferential> DampedComposition::do_differential() const {
  return ComposedDifferential::of(name(), {steps_[0]->differential(), steps_[1]->differential()});
}

std::unique_ptr<Stepper> DampedComposition::do_stepper() const {
  return std::make_unique<Trajectory>(steps_, name());
}

}  // namespace courant
