// Unknowns that have other values as well where a run begins.
#pragma once

#include <vector>

#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/reading/experiment.hpp"
#include "courant/running/consistent_start.hpp"
#include "courant/running/ladder_report.hpp"

namespace courant {

// Of unknowns that are not given and that the equations determine near the point of the ladder, those for
// which the equations, in which they are not linear, have another solution with the same coordinates that
// is found from their opposite: from what they are at the start to that. An equation such as
// x² + y² = 1 is solved by y and -y, and which of them a run begins with is a choice. For systems of up to
// 50 unknowns.
std::vector<Movement> other_values(const Experiment& experiment, const ConstraintLadder& ladder);

// What the report of a ladder does not know of the start that it is of: these as its choices, and whether it was an
// impulse.
void tell_of_start(const Experiment& experiment, const ConsistentStart& start,
                   LadderReport& report);

// Those of a start, with the parameters of the experiment by name.
ConstraintFormulas formulas_of_start(const Experiment& experiment, const ConsistentStart& start);

// ladder_report of a start with these, and with that.
LadderReport report_of_start(const Experiment& experiment, const ConsistentStart& start);

}  // namespace courant
