// Steps that are chosen by a tolerance.
#pragma once

#include <atomic>
#include <memory>
#include <optional>

#include "courant/core/expressions/backend.hpp"
#include "courant/reading/experiment.hpp"

namespace courant {

// A step and what it was chosen by: how far the run with this step is from that with a half of it, at its rows, next to
// the distance from the least to the greatest value in the run; of voltages of a network, and of its currents, next to
// the greatest of these distances. A row may be an edge of a waveform: the least ε such that no more than the part ε of
// the rows differs by more than ε.
struct ChosenStep {
  double step = 0.0;
  // Of the coordinates, of those of a network as voltages and currents, ∂H/∂x; infinite where not even two rows were
  // reached.
  double estimate = 0.0;
  double observed = 0.0;  // of potentials, voltages and currents that are observed
  // Where these runs ended, if before their end.
  std::optional<double> ended_at = std::nullopt;
};

// Of an experiment whose `time` has a tolerance and no step: the longest of h, h/2, h/4, … whose estimates are not
// above the tolerance, where h is the time between rows (`output`), or a thousandth of the run. One step is kept for
// the whole run, so that a method keeps what it promises. The experiment is run without files, to its end, with each
// step that is tried; steps that are far too long are passed over by the order of their errors. Where corners end
// steps the run with a half makes two of each piece. Where a million steps do not do, or the estimate no longer falls,
// the step with the least one; of what is observed as soon as that no longer falls, since it may be round-off where
// the coordinates are not; where the rows are more than a million, theirs. Events that set something or stop the run
// do so in the trials. A run whose next step cannot be made ends, as at an impasse or a pole: runs are compared up to
// there. A row that one of two runs has alone differs.
ChosenStep chosen_step(const Experiment& experiment, Backend backend = Backend::interpreter,
                       const std::atomic<bool>* stop = nullptr);

// The experiment with that step, as one that has it; with a remark where its estimate is above the tolerance, or no run
// came to its end.
std::shared_ptr<const Experiment> with_chosen_step(const Experiment& experiment,
                                                   const ChosenStep& chosen);

}  // namespace courant
