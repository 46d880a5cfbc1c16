#include "courant/integrators/methods/transformed_integrator.hpp"

#include <cmath>
#include <utility>

#include "courant/core/words/message.hpp"
#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/integrators/step/step_parts.hpp"

namespace courant {

// The stepper of the method goes along the extended states, which are kept from step to step.
class TransformedIntegrator::Trajectory final : public Stepper {
 public:
  Trajectory(std::shared_ptr<const TimeTransformation> transformation,
             std::shared_ptr<const Integrator> method, const std::string& name)
      : Stepper(name, transformation->system()),
        transformation_(std::move(transformation)),
        integrator_(std::move(method)),
        inner_(integrator_->stepper()) {}

 private:
  void do_prepare(State& state, double h) override {
    at_ = transformation_->to_extended(state);
    const double t = state.t;
    inner_->prepare(at_, h);
    if (expected_) inner_->expect(*expected_);
    expected_.reset();
    state = transformation_->from_extended(at_);
    state.t = t;
  }

  void do_step(const State& before, double h, State& after) override {
    if (tells_parts()) inner_->tell_parts();
    next_ = at_;
    next_.t = 0.0;
    try {
      const CountedWork counted(statistics_, *inner_);
      inner_->step(next_, h, 0.0);
    } catch (const SolveError& error) {
      throw error.of_step(method(), before.t, h);
    }
    // No step depends on τ: that of an extended state is 0.
    next_.t = 0.0;
    after = transformation_->from_extended(next_);
    check_time(before.t, after.t, h);
  }

  void check_time(double before, double after, double h) const {
    const double rate = (after - before) / h;
    if (rate > 0.0) return;
    throw SolveError(SolveError::Reason::left_domain, method(), before, h,
                     "advances the time by " + number_text(rate) +
                         " h: dt/dtau has to be positive along the step, and large enough for time "
                         "to go on.");
  }

  void do_keep(const State&, const State&) override {
    at_.swap(next_);
    step_ = in_own_time(inner_->last());
  }
  void do_stage(Step& step) const override {
    step.rate = (step.after.t - step.before.t) / step.h;
    step.stage = step_.stage;
    step.effort = step_.effort;
    step.parts = step_.parts;
  }

  Step in_own_time(const Step& extended) const {
    Step own{.h = extended.h,
             .before = transformation_->from_extended(extended.before),
             .after = transformation_->from_extended(extended.after),
             .stage = transformation_->from_extended(extended.stage),
             .effort = transformation_->covector(extended.effort)};
    own.rate = (own.after.t - own.before.t) / own.h;
    // Parts that nobody asked for are empty.
    for (const Step& part : extended.parts)
      own.parts.push_back(part.stage.x.size() > 0 ? in_own_time(part) : Step{});
    return own;
  }

  void do_discard() override { inner_->forget(); }
  void do_forget() override {
    inner_->forget();
    expected_.reset();
  }
  Motion do_motion() const override { return inner_->motion(); }
  void do_expect(const Motion& motion) override { expected_ = motion; }
  bool do_keeps_to_manifold() const override { return false; }
  std::unique_ptr<Stepper> do_fresh() const override {
    return std::make_unique<Trajectory>(transformation_, integrator_, method());
  }

  std::shared_ptr<const TimeTransformation> transformation_;
  std::shared_ptr<const Integrator> integrator_;
  std::unique_ptr<Stepper> inner_;
  State at_, next_;  // extended: where the last step that stands ended, and the one that is made
  Step step_;        // the last that stands
  std::optional<Motion> expected_;  // for the step after the next preparation
};

TransformedIntegrator::TransformedIntegrator(
    std::shared_ptr<const TimeTransformation> transformation,
    std::shared_ptr<const Integrator> method)
    : IntegratorAdaptor("TransformedIntegrator",
                        transformation ? transformation->system() : nullptr,
                        transformation ? transformation->extended() : nullptr, std::move(method)),
      transformation_(std::move(transformation)) {}

ConstraintLadder extended_ladder(const TimeTransformation& transformation, const State& initial) {
  const State start = transformation.to_extended(initial);
  return ConstraintAlgorithm().run(transformation.extended(),
                                   {.t = start.t, .x = start.x, .v = start.v, .z = start.z});
}

std::unique_ptr<Stepper> TransformedIntegrator::do_stepper() const {
  return std::make_unique<Trajectory>(transformation_, wrapped(), name());
}

}  // namespace courant
