// What stands under the title of a report.
#pragma once

#include <span>

#include "courant/plotting/svg.hpp"
#include "courant/running/run_files.hpp"

namespace courant {

// The systems and how many runs; their status; the equations and parameters of the experiment, where
// all runs have the same, as they are written there. Formulas of more than 300 characters, and what
// comes after twelve of them, are left to the experiment at the end of the page.
plot::Markup report_head(std::span<const Run> runs);

}  // namespace courant
