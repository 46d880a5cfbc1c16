// Words on the branches of a system.
#pragma once

#include <vector>

#include "courant/reporting/prose.hpp"
#include "courant/running/branch_report.hpp"

namespace courant {

// A line each branch: its number, equations, ladder and distance from the initial values, under a line that says how to
// choose. Nothing where there are none.
std::vector<Prose> branches_in_words(const std::vector<BranchReport>& branches);

}  // namespace courant
