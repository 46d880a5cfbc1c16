// EnsembleMember: what the run of a member leaves.
#pragma once

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "courant/reading/expectation.hpp"
#include "courant/running/run_watcher.hpp"

namespace courant {

// The run of member i of an ensemble. Its rows have the bits of the run of the experiment with the values of the member
// (`courant run --set`); where it ends early there are fewer.
struct EnsembleMember {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  Index number = 0;
  RunStatus status = RunStatus::failed;
  std::string message = {};  // why it did not complete
  std::string warning = {};  // the first of its run
  long steps = 0;
  double max_drift = kUnknown;      // of H
  double max_violation = kUnknown;  // of the constraints
  std::string ladder =
      {};  // of its start: "regular: (8, 6), (6, 6)", the dimensions of S_k and M_k
  std::vector<ExpectationResult> expectations = {};
  std::vector<double> rows = {};  // t first, one row after the other
  // By time: the name, then the time and what is measured there.
  std::vector<std::pair<std::string, std::vector<double>>> events = {};
};

// What is known of an ensemble before its first member.
struct EnsembleOpening {
  Index members = 0, rows = 0;
  std::vector<std::string> columns = {};  // names, t first
  std::vector<std::string> event_columns =
      {};  // of what is measured at events, t first; empty without events

  Index numbers_of_member() const { return rows * static_cast<Index>(columns.size()); }
};

}  // namespace courant
