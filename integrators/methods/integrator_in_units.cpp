#include "courant/integrators/methods/integrator_in_units.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "courant/integrators/certificate/chart_equations.hpp"
#include "courant/integrators/step/natural_units.hpp"
#include "courant/integrators/step/step_differential.hpp"
#include "courant/integrators/step/step_parts.hpp"
#include "courant/integrators/step/step_program.hpp"

namespace courant {
namespace {

// `time`: what becomes of 1.
Step in_other_units(const Step& step, double time,
                    const std::function<State(const State&)>& converted) {
  Step result{.h = time * step.h,
              .before = converted(step.before),
              .after = converted(step.after),
              .stage = converted(step.stage)};
  result.rate = step.rate;
  for (const Step& part : step.parts) result.parts.push_back(in_other_units(part, time, converted));
  return result;
}

}  // namespace

// The stepper of the method goes along the measured states.
class IntegratorInUnits::Trajectory final : public Stepper {
 public:
  Trajectory(std::shared_ptr<const ImplicitSystem> system, Units units,
             std::shared_ptr<const Integrator> method)
      : Stepper(method->name(), system),
        system_(std::move(system)),
        units_(std::move(units)),
        integrator_(std::move(method)),
        inner_(integrator_->stepper()) {}

 private:
  void do_prepare(State& state, double h) override {
    State measured = units_.measure(state);
    inner_->prepare(measured, h / units_.time);
    state = units_.restore(measured);
  }

  void do_step(const State& before, double h, State& after) override {
    if (tells_parts()) inner_->tell_parts();
    units_.measure(before, at_);
    try {
      const CountedWork counted(statistics_, *inner_);
      inner_->step(at_, h / units_.time, after.t / units_.time);
    } catch (const SolveError& error) {
      throw error.of_step(method(), before.t, h, units_.time);
    }
    units_.restore(at_, after);
  }

  void do_keep(const State&, const State&) override {
    const Step& last = inner_->last();
    units_.restore(last.stage, stage_);
    if (tells_parts())
      parts_ = in_other_units(last, units_.time, [&](const State& state) {
                 return units_.restore(state);
               }).parts;
  }
  void do_stage(Step& step) const override {
    step.stage = stage_;
    step.parts = parts_;
  }

  void do_discard() override { inner_->forget(); }
  void do_forget() override { inner_->forget(); }
  Motion do_motion() const override { return inner_->motion(); }
  void do_expect(const Motion& motion) override { inner_->expect(motion); }
  std::unique_ptr<Stepper> do_fresh() const override {
    return std::make_unique<Trajectory>(system_, units_, integrator_);
  }

  std::shared_ptr<const ImplicitSystem> system_;
  Units units_;
  std::shared_ptr<const Integrator> integrator_;
  std::unique_ptr<Stepper> inner_;
  State at_;     // measured
  State stage_;  // of the last step that stands
  std::vector<Step> parts_;
};

class IntegratorInUnits::Differential final : public StepDifferential {
 public:
  Differential(Units units, std::shared_ptr<const StepDifferential> measured)
      : units_(std::move(units)), measured_(std::move(measured)) {}

 private:
  MatrixXd do_images(const Step& step, const MatrixXd& V) const override {
    const auto u = units_.tangent.asDiagonal();
    return u * (*measured_)(measured(step), u.inverse() * V);
  }
  MatrixXd do_pull_back(const Step& step, const MatrixXd& Lambda) const override {
    const auto u = units_.tangent.asDiagonal();
    return u.inverse() * measured_->pull_back(measured(step), u * Lambda);
  }
  Step measured(const Step& step) const {
    return in_other_units(step, 1.0 / units_.time,
                          [&](const State& state) { return units_.measure(state); });
  }

  Units units_;
  std::shared_ptr<const StepDifferential> measured_;
};

IntegratorInUnits::IntegratorInUnits(const std::shared_ptr<const SystemInUnits>& system,
                                     std::shared_ptr<const Integrator> method)
    : IntegratorAdaptor("IntegratorInUnits", system ? system->system() : nullptr, system,
                        std::move(method)),
      units_(system->units()) {}

std::unique_ptr<Stepper> IntegratorInUnits::do_stepper() const {
  return std::make_unique<Trajectory>(system(), units_, wrapped());
}

std::vector<StepFormulas> IntegratorInUnits::do_formulas() const {
  std::vector<StepFormulas> formulas = wrapped()->formulas();
  for (StepFormulas& step : formulas) step.name += ", in natural units";
  return formulas;
}

StepProgram IntegratorInUnits::program() const {
  StepProgram program = step_program(*wrapped());
  program.units = units_;
  return program;
}

std::shared_ptr<const StepDifferential> IntegratorInUnits::do_differential() const {
  auto measured = wrapped()->differential();
  if (!measured) return nullptr;
  return std::make_shared<Differential>(units_, std::move(measured));
}

std::optional<Units> needed_units(const std::shared_ptr<const ChartEquations>& equations,
                                  const State& at) {
  const State point = without_round_off(equations, at);
  constexpr double comparable = 1e6, usual_time = 1e9;
  constexpr double most = 1e90;  // products of three have to be numbers
  auto units = units_of_all_terms(equations, point);
  // Velocities of zero beside others may leave units open that equations tell alone.
  if (!units) units = units_of_all_terms(equations, {.t = point.t, .x = point.x});
  if (!units || units->coordinates.size() == 0) return std::nullopt;
  const double smallest = units->coordinates.minCoeff(), largest = units->coordinates.maxCoeff();
  if (std::min(smallest, units->time) < 1.0 / most || std::max(largest, units->time) > most)
    return std::nullopt;
  const bool are_comparable = largest <= comparable * smallest;
  if (are_comparable && units->time <= usual_time && units->time >= 1.0 / usual_time)
    return std::nullopt;
  return units;
}

std::optional<Units> needed_units(const std::shared_ptr<const ImplicitSystem>& system,
                                  const State& point) {
  return needed_units(std::make_shared<const ChartEquations>(system), point);
}

}  // namespace courant
