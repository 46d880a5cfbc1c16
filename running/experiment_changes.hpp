// What is not the same in two experiments.
#pragma once

#include <vector>

#include "courant/reading/findings.hpp"

namespace courant {

// The places where an experiment differs from that with which a run was begun, both with their
// defaults filled in: `/method/order: is 4; the run was begun with 2`. Not among them are the end of
// the time and the id of the run ($run). The order of keys counts, but for those of the whole
// experiment: columns and definitions stand in that order.
std::vector<Problem> experiment_changes(const Json& begun, const Json& now);

}  // namespace courant
