// Steps that are chosen by a tolerance.
#pragma once

#include <atomic>
#include <memory>
#include <optional>

#include "courant/core/expressions/backend.hpp"
#include "courant/reading/experiment.hpp"

namespace courant {

// A step and what it was chosen by: the greatest difference of a coordinate between the run with this step and that
// with a half of it, next to the distance from the least to the greatest value of the coordinate in the run.
struct ChosenStep {
  double step = 0.0;
  double estimate = 0.0;  // infinite where not even two rows were reached
  // Where these runs ended, if before their end.
  std::optional<double> ended_at = std::nullopt;
};

// Of an experiment whose `time` has a tolerance and no step: the longest of h, h/2, h/4, … whose estimate is not
// above the tolerance, where h is the time between rows (`output`), or a thousandth of the run. One step is kept for
// the whole run, so that a method keeps what it promises. The experiment is run without files, to its end, with each
// step that is tried; steps that are far too long are passed over by the order of their errors. Where a million
// steps do not do, or the estimate no longer falls, the step with the least one; where the rows are more than that,
// theirs. Events that set something or stop the run do so in the trials; where one of two runs has jumped and the
// other not yet they are not compared, and the part of the time in which that is so is added to the estimate. A run
// whose next step cannot be made ends within that step, as at an impasse or a pole: runs are compared up to there,
// and the time between two such ends is added likewise.
ChosenStep chosen_step(const Experiment& experiment, Backend backend = Backend::interpreter,
                       const std::atomic<bool>* stop = nullptr);

// The experiment with that step, as one that has it; with a remark where its estimate is above the tolerance, or no run
// came to its end.
std::shared_ptr<const Experiment> with_chosen_step(const Experiment& experiment,
                                                   const ChosenStep& chosen);

}  // namespace courant
