// Which back end the functions of a run are worth.
#pragma once

#include "courant/core/expressions/backend.hpp"
#include "courant/reading/experiment.hpp"

namespace courant {

// The back end asked for, but in place of the automatic one the interpreter where the run is short: the compiler takes
// a good part of a second, and many for formulas of thousands of instructions, and saves some nanoseconds an
// instruction in each step. `alike`: how many runs there are whose code is the same, but for numbers, which is compiled
// once.
Backend worthwhile(const Backend& asked, const Experiment& experiment, long alike = 1);

}  // namespace courant
