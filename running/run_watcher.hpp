// RunWatcher: what is told of every state of a run.
#pragma once

#include <optional>
#include <string>

#include "courant/integrators/step/step.hpp"

namespace courant {

// not_finite: made all its steps, but something that is observed was not a number at some of them.
enum class RunStatus { running, completed, failed, interrupted, not_finite };

// Why a run ends before its last step.
struct RunEnd {
  RunStatus status = RunStatus::failed;
  std::string message = {};
};

// A state of a run, k = 0, 1, …, steps. In transformed time `steps` is what it looks like, more than k
// but at the last state.
struct RunMoment {
  long k = 0, steps = 0;
  double t = 0.0;
  const VectorXd& row;  // what is measured there, in the order of Observer::names()
  const Step& step;     // ends at the state, which is step.after; of no meaning otherwise at k = 0
  std::optional<double> tau = {};  // transformed time, if there is one
};

// The writer of the trajectory, statistics, the watch over the ladder, progress: all that a run
// does with its states. Each gets every state, in the order of time; a run that one of them ends is
// told to the others first.
class RunWatcher {
 public:
  virtual ~RunWatcher() = default;
  // Why the run ends with this state; nothing if it goes on.
  virtual std::optional<RunEnd> watch(const RunMoment& moment) = 0;
  // Whether it asks what steps were evaluated at: then steps are not made ahead.
  virtual bool needs_stages() const { return true; }
};

}  // namespace courant
