// The tables of a report.
#pragma once

#include <span>
#include <string>

#include "courant/plotting/svg.hpp"
#include "courant/running/run_files.hpp"

namespace courant {

// A run a column: status, steps, step size, solver statistics, speed.
plot::Markup runs_table(std::span<const Run> runs, std::span<const std::string> labels);

// An observable and a run a row: initial, final, least, greatest value and drift.
plot::Markup observables_table(std::span<const Run> runs, std::span<const std::string> labels);

// "41 of 43 expectations passed", a table of those that failed, and those that passed, folded: an
// expectation a row, with what was measured, the bound, and passed or failed. Empty when there is
// none.
plot::Markup expectations_table(std::span<const Run> runs, std::span<const std::string> labels);

// The levels of a ladder: dimensions, fibre, the gap of the rank decision, residual.
plot::Markup ladder_table(const LadderReport& ladder);

}  // namespace courant
