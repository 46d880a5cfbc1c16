// What the constraint algorithm finds on each branch of a system.
#pragma once

#include <string>
#include <vector>

#include "courant/reading/experiment.hpp"
#include "courant/running/ladder_report.hpp"

namespace courant {

// A branch of the system of an experiment (branches()), and the algorithm restarted on it at the initial values.
struct BranchReport {
  Index number = 0;  // of "branch"
  bool is_chosen = false;
  Index level = 0;                     // of the ladder of the whole system, at which it is seen
  std::vector<std::string> equations;  // f, each = 0
  // Verdict, levels and point alone, as discrete_ladder_report() has them.
  LadderReport ladder;
  double moved = 0.0;        // how far the given coordinates are from the start on it
  std::string problem = {};  // why initial values are refused there; empty if they are not
};

// All branches, also where the experiment has chosen one. None of a system that is no product.
std::vector<BranchReport> branch_reports(const Experiment& experiment);

// The JSON of a ladder with "branches": a list of
//   {"branch": 1, "chosen": false, "level": 0, "equations": ["x"], "verdict": "regular", "ladder": [[1, 1]],
//    "degrees_of_freedom": 1, "moved": 0.0}
// as it is where there are none.
Json with_branches(Json ladder, const std::vector<BranchReport>& branches);

}  // namespace courant
