// ObserverElsewhere: what is measured where no step of a run ends.
#pragma once

#include <optional>
#include <vector>

#include "courant/running/observer.hpp"

namespace courant {

// Rows of an Observer at states that its run does not come to: of steps of another size, of parts of its
// steps. It has an observer of its own, made when it is needed, so that the run's knows nothing of it.
class ObserverElsewhere {
 public:
  // `of` observes the run; all of these outlive this.
  ObserverElsewhere(const Experiment& experiment, const ConstraintLadder& ladder,
                    const Observer& of)
      : experiment_(experiment), ladder_(ladder), of_(of) {}

  // References to rows are valid until the next call.
  const VectorXd& row(const State& state) { return at(state).row(state); }
  EnergySizes energy_sizes(const State& state) { return at(state).energy_sizes(state); }

  // Parts of the run's next step begin with what its observer knows now.
  void begin_step() { before_ = of_.memory(); }
  // The row at the end of a part of that step, with the energies and the tangent map up to there.
  const VectorXd& row_within(const Step& part);

 private:
  Observer& at(const State& state);

  const Experiment& experiment_;
  const ConstraintLadder& ladder_;
  const Observer& of_;
  std::optional<Observer> own_;
  Observer::Memory before_;
};

}  // namespace courant
