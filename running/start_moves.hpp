// How far a start is from what was typed.
#pragma once

#include <string>

#include "courant/reading/experiment.hpp"
#include "courant/running/impulsive_start.hpp"

namespace courant {

// The given positions, velocities, momenta and unknowns, each as a vector of the numbers of the experiment: how far it
// moved to be consistent, next to what it is, and next to the last digit that was typed of it. What impulses move is
// meant to, and no such move.
struct StartMoves {
  // One sentence for each kind that moved by more than rounding explains, and one where the start was not shown to be
  // the nearest; empty if there is nothing to say.
  std::string warning;
  // Why the start is no start of a run: an impasse, or a kind that moved by more than a tenth of itself, though nothing
  // says that its values may move ("start": "nearest", or "hold" for those that must not). Unknowns choose branches and
  // may always.
  std::string refusal;
};

// `ladder`: the consistent start of the experiment.
StartMoves start_moves(const Experiment& experiment, const ConsistentStart& ladder);

// consistent_start, for a run that begins there. Throws ExperimentError where it moved too far for one: without a
// method nothing begins.
ConsistentStart start_of_run(const Experiment& experiment);

}  // namespace courant
