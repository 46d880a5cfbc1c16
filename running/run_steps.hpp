// RunSteps: the steps of a run, one after the other.
#pragma once

#include <map>
#include <memory>
#include <optional>

#include "courant/integrators/step/integrator.hpp"
#include "courant/reading/expectation.hpp"

namespace courant {

// Makes the steps of a run, and after each epoch forgets those before: what goes on from a checkpoint makes the
// same ones.
//
// Where nobody looks into steps they may be made ahead, by a thread of their own, up to some thousand of them: what a
// run does with its states then takes no time of its steps. Steps, and what is known after each of them, are the same
// either way; next() waits for what is not there yet, and throws where it would be.
class RunSteps {
 public:
  // After step k, which ended at `state`; the motion is that of the epoch which ended there, none for the start
  // of a run, where the state is prepared.
  struct Start {
    long k = 0;
    State state = {};
    std::optional<Motion> motion = {};
    // Points from which the next step begins after step k, instead of where that ended.
    std::map<long, VectorXd> nodes = {};
  };
  // `integrator` and `time` are to live as long as this.
  RunSteps(const Integrator& integrator, const TimeSpan& time, long epoch, Start start, bool ahead);
  // Waits for the step that is being made, not for those after it.
  ~RunSteps();

  // Before the first step. Throws what Stepper::prepare does.
  void begin();
  // Makes a step, not one beyond the last. Throws what Stepper::step does.
  void next();
  // In place of next(), of steps that are not made ahead: the step ended at this state.
  void skip_to(const State& state);
  // The last step, of steps that are not made ahead, ended at this state instead.
  void replace(const State& state);
  long k() const { return k_; }  // the step that it was, or that of the start
  // That step, without what it was evaluated at, and where it ended; valid until next(). Before the first one, where
  // that begins. `before` is where the step before ended, maybe prepared once more.
  const Step& ended() const;
  // Where the next step begins, which may be moved where steps are not made ahead.
  State& state();
  // Of the steps up to that one, and of an attempt that next() failed with.
  const SolverStatistics& statistics() const;

  // Whether an epoch ends with that step; none does with the last one.
  bool is_epoch_over() const { return k_ == end_ && k_ < time_.steps; }
  // What the steps of an epoch that is over were like. To be called then, before next().
  Motion end_epoch();

  // Of steps that are not made ahead.
  Stepper& stepper() { return *stepper_; }

 private:
  class Ahead;

  // state() of steps that are not made ahead, to be read.
  const State& reached() const;

  const TimeSpan& time_;
  const long epoch_;
  long k_, end_;                      // that of the epoch
  std::unique_ptr<Stepper> stepper_;  // of these one is null
  std::unique_ptr<Ahead> ahead_;
  Start start_;  // its state goes on, where steps are not made ahead,
  bool goes_on_ =
      false;  // but where the next step begins at the end of the last one, which nobody has asked for
};

}  // namespace courant
