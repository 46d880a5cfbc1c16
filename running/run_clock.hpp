// RunClock: where a run is in time.
#pragma once

#include <optional>

#include "courant/integrators/step/stepper.hpp"
#include "courant/reading/expectation.hpp"

namespace courant {

// The times of the states of a run. With steps of one size in t they are those of the TimeSpan. In
// transformed time they are those of the states, and the last step is as long as leads to the end of
// the run.
class RunClock {
 public:
  // Without a time there is one state.
  explicit RunClock(const std::optional<TimeSpan>& time) : time_(time) {}

  bool is_transformed() const { return time_ && time_->is_transformed(); }
  // Whether step k, told of by end_step, is the last one of a run in transformed time.
  bool is_last() const { return is_last_; }
  // After the step that end_step was told of; 0 before.
  double tau() const { return tau_; }
  // Of the state after step k.
  double t(const State& state, long k) const;
  // How many steps it takes to the end, as it looks after k of them at the time t: exact with steps of
  // one size in t, and for the last step.
  long steps(long k, double t) const;

  // Step k of a run in transformed time was made. If it goes beyond the end of the run it is made again
  // to end there. Throws as Stepper::step does.
  void end_step(Stepper& stepper, State& state, long k);

 private:
  const std::optional<TimeSpan>& time_;
  double tau_ = 0.0;
  bool is_last_ = false;
};

}  // namespace courant
