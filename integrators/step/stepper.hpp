// Stepper: the workspace of a one-step method.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "courant/integrators/step/solve_error.hpp"
#include "courant/integrators/step/step.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

// What the solver of the steps has done since it was made: counts, all from 0.
struct SolverStatistics {
  long steps = 0;
  long iterations = 0;
  long factorizations = 0;
  long failures = 0;         // iterations that failed and were begun again
  long second_attempts = 0;  // steps that were made in more than one attempt
  long confirmations = 0;    // solutions that were looked at by continuation in h
  long divisions = 0;        // steps that could not be made at once, and were made in halves

  // Takes over what the solver of another stepper did from `before` to `now`. Steps are counted by each
  // stepper itself.
  void add_work(const SolverStatistics& before, const SolverStatistics& now) {
    iterations += now.iterations - before.iterations;
    factorizations += now.factorizations - before.factorizations;
    failures += now.failures - before.failures;
    confirmations += now.confirmations - before.confirmations;
  }
};

// What a one-step method keeps from step to step in order to be quick: extrapolations,
// factorisations, bases that move along. The state belongs to the caller:
//
//   State state = …;
//   const auto stepper = integrator.stepper();
//   for (long k = 1; k <= steps; ++k) stepper->step(state, h, t0 + k * h);
//
// Laws:
//   W1  a step depends on (state, h) alone, up to round-off: a fresh stepper makes the same step
//   W2  after forget() it does so to the last bit
//   W3  a step that throws leaves the state as it was, and the steps after it are those that would
//       have been made without it (factorisations are made anew, so up to round-off)
//
// One stepper a thread. States may be of one trajectory or of several, steps of any size and sign;
// quick are sequences of equal steps along a smooth curve, those of the stages of a composition
// (each with a stepper of its own) included.
class Stepper {
 public:
  virtual ~Stepper() = default;

  // Brings a state to where steps of about the size h begin: what is not given of v and z becomes
  // zero; a method on M_f moves x there and finds v and z. Steps begin with this where the state is
  // not the one that the last step ended at. Throws as step does.
  void prepare(State& state, double h);

  // (t, x) ↦ (t + h, Φ_h(x)). `end`: t + h as the caller's clock has it, so that time does not
  // collect round-off. Where h is a step in another time, see TransformedIntegrator, the time is the
  // method's.
  //
  // Throws std::invalid_argument unless the state fits the system and h is finite and not zero. Throws
  // std::domain_error unless x is on the manifold up to 1e-6, which explicit methods do not ask as they
  // leave it, and has directions to project in. Throws SolveError if the step cannot be made.
  void step(State& state, double h, double end);
  void step(State& state, double h) { step(state, h, state.t + h); }
  // The same step. Where the state is that at which the last step of `other` ended, a stepper of the
  // same method, what that knows of the state (bases, directions, derivatives) is taken over, not
  // found again.
  void step_from(const Stepper& other, State& state, double h, double end);

  // A step from where the last one ended, or from what was prepared, which need not be told again: ended() says
  // where it leads. The same step. Throws std::logic_error where nothing was prepared since the beginning or
  // forget(), and as step().
  void go_on(double h, double end);

  // The last step; before the first one, `after` is the state that was prepared. Valid until the
  // next step is made.
  const Step& last();

  // The same without what is to be evaluated for it: of stage, effort and parts nothing is told.
  const Step& ended() const { return *last_; }

  // The curve of the last step: Φ_{sh} of the state before, for 0 ≤ s ≤ 1. Of the method's order,
  // on M_f where the method is; each point costs what a step costs. Throws std::logic_error before
  // the first step, std::invalid_argument for s outside [0, 1], SolveError.
  State between(double s);
  // The step from the state before to between(s).
  Step part(double s);
  // The s in [0, 1] at which the curve of the last step has the time t, to round-off; for a t between
  // the times of its ends, else std::invalid_argument. Where steps are of one size in t nothing is
  // evaluated.
  double share_at(double t);

  // From the next step on last() and part() tell the parts of steps that are made of several, which
  // costs a copy of each.
  void tell_parts() { tells_parts_ = true; }

  // As if no step had been made; the statistics go on.
  void forget();

  // The steps so far, for a stepper of the same method that knows nothing of them: a fresh one, or
  // this after forget(). With expect() its first step, which goes on with the motion by the same h, need
  // not be looked at by continuation. It is the same step.
  Motion motion() const { return do_motion(); }
  void expect(const Motion& motion) { do_expect(motion); }

  // Another stage of the composition that this is a stage of, or this one in the step before: its
  // last step is near the next one of this in time, and was predicted from as many steps before. What
  // its prediction was wrong by, times `at_stage` for what belongs to the stage and `at_end` for what
  // belongs to the end, corrects that of this.
  struct Companion {
    const Stepper* stepper;
    double at_stage, at_end;
    double ratio;  // of the step of this to that of the companion: displacements go like steps
  };
  // Steppers of the same method, which live as long. Steps stay the same.
  void accompany(std::span<const Companion> companions) { do_accompany(companions); }

  const SolverStatistics& statistics() const { return statistics_; }

 protected:
  // `method` is named in messages.
  Stepper(std::string method, std::shared_ptr<const ImplicitSystem> system);
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;

  const ImplicitSystem& system() const { return *system_; }
  const std::shared_ptr<const ImplicitSystem>& shared_system() const { return system_; }
  const Manifold& manifold() const { return *system_->manifold(); }
  const std::string& method() const { return method_; }
  bool tells_parts() const { return tells_parts_; }

  SolverStatistics statistics_;

 private:
  // To subclass, override:
  // From `before`, which is where the last step ended or prepared, by h to the time after.t: writes
  // the rest of `after`, whose v and z have any sizes. Throws SolveError. What is kept for later
  // steps, and the stage of the last one, stay as they are until do_keep.
  virtual void do_step(const State& before, double h, State& after) = 0;
  // The step that was just made stands.
  virtual void do_keep(const State& before, const State& after) = 0;
  // Writes step.stage of the last step that stands.
  virtual void do_stage(Step& step) const = 0;
  // As after construction.
  virtual void do_forget() = 0;
  // A stepper of the same method.
  virtual std::unique_ptr<Stepper> do_fresh() const = 0;

  // May override:
  // As expect() and motion() say; nothing where no step is looked at.
  virtual Motion do_motion() const { return {}; }
  virtual void do_expect(const Motion&) {}
  // The step does not stand, or was not made.
  virtual void do_discard() {}
  // The next step begins at this state, which is not where the last one ended; v and z have their
  // sizes.
  virtual void do_prepare(State&, double /*h*/) {}
  // The next step begins where the last one of the other stepper ended, which takes the place of
  // do_prepare. False, with nothing changed: what the other one knows is of no use.
  virtual bool do_take_over(const Stepper& /*other*/) { return false; }
  // As accompany() says.
  virtual void do_accompany(std::span<const Companion>) {}
  // Whether steps stay on the manifold: then a state off it is refused.
  virtual bool do_keeps_to_manifold() const { return true; }
  // The next step is of another size: what extrapolates those before is of no use.
  virtual void do_change_step() {}

  [[noreturn]] void refuse(double h) const;
  void check(const State& state) const;
  void take_up(State& state, double h, const Stepper* from = nullptr);
  void make_step(State& state, double h, double end, const Stepper* from);
  void make_prepared_step(bool goes_on, double h, double end);
  bool is_near_last(const State& state) const;

  std::string method_;
  std::shared_ptr<const ImplicitSystem> system_;
  Step steps_[2];
  Step *last_ = &steps_[0], *trial_ = &steps_[1];
  bool has_stepped_ = false;  // since the last forget()
  bool has_stage_ = false;    // last_ has that of its step
  bool is_prepared_ = false;  // for a step from last_->after
  bool tells_parts_ = false;
  std::unique_ptr<Stepper> between_;
};

}  // namespace courant
