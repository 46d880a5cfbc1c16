// RunResults: what is known of a run so far.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "courant/integrators/step/stepper.hpp"
#include "courant/reading/experiment.hpp"
#include "courant/running/event_watch.hpp"
#include "courant/running/observer.hpp"
#include "courant/running/quantity_statistics.hpp"
#include "courant/running/run_summary.hpp"
#include "courant/running/run_watcher.hpp"
#include "courant/running/symmetry_check.hpp"

namespace courant {

// What a run collects on its way, and what its summary and its expectations are made of. The
// references are to live as long as this.
struct RunResults {
  const Experiment& experiment;
  const ConstraintLadder& ladder;
  const LadderReport& ladder_report;
  const std::vector<SymmetryFinding>& symmetries;
  const Observer& observer;

  std::string id = {};  // of the run's folder
  RunStatus status = RunStatus::completed;
  std::string message = {};
  std::vector<std::string> warnings = {};
  QuantityStatistics statistics = {};  // of the observer's rows
  std::map<double, VectorXd> rows_at_times = {};
  const EventWatch* event_watch = nullptr;  // null where there are no events
  long steps = 0;
  double t = 0.0;  // after the last of them
  SolverStatistics solver = {};
  std::string metric = {};  // as of PreparedMethod
  std::string backend = "interpreter";
  std::optional<RunSummary::Engine> engine = {};
  double wall_seconds = 0.0;
  double cpu_seconds = 0.0;  // of all threads of this process

  // The greatest |constraint[i]|, NaN where there are none.
  double max_violation() const;
  // One for each entry of `expect`.
  std::vector<ExpectationResult> expectations() const;
  // With this status, `running` before the end, and these results of expectations.
  RunSummary summary(RunStatus told_status, const std::vector<ExpectationResult>& results) const;
};

}  // namespace courant
