// A run as it is carried out, step by step.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "courant/core/numbers/parallel.hpp"
#include "courant/core/solve/equation_engine.hpp"
#include "courant/reading/experiment.hpp"
#include "courant/running/impulsive_start.hpp"
#include "courant/running/run_folder.hpp"
#include "courant/running/run_keeper.hpp"
#include "courant/running/run_summary.hpp"
#include "courant/running/run_watchers.hpp"

namespace courant {

// Where a run goes, how it is carried out, and who is told of it.
struct RunOptions {
  std::filesystem::path folder;
  Backend backend = Backend::automatic;
  // What solves the equations of the steps; null: this process. All else is done here: the constraint algorithm, what
  // is observed, the files.
  std::shared_ptr<const EquationEngine> engine = nullptr;
  ExistingRun existing = ExistingRun::refuse;  // a run that is in the folder already
  const std::atomic<bool>* stop = nullptr;     // set by someone else: the run is interrupted
  std::function<void(const LadderReport&)> on_ladder;  // once the constraint algorithm has finished
  std::function<void(const Integrator&)> on_method = {};  // once it is made ready
  // Before the first file is written: until then there is nothing to be kept of the run.
  std::function<void()> on_begin = {};
  std::function<void(const Progress&)> on_progress;  // some ten times a second
  std::vector<RunWatcher*> watchers = {};            // are told of every state too
  // Whether a thread of its own may make steps ahead of what is done with them, see RunSteps. All else is done, and
  // all of these are called, in the thread that called run().
  bool ahead = core_count() > 1;
  // How many runs have the code of this one, but for numbers: the cases of a sweep, the members of an ensemble.
  long alike = 1;
  // Whether the summary has the constraints of the start in formulas, which takes a part of the set-up.
  bool explains_start = true;
  // A run that goes on: after which step, at which time; 0 from its start.
  std::function<void(long k, double t)> on_resume = {};
  // At least so much time from one checkpoint on the disk to the next.
  std::chrono::duration<double> checkpoint_interval = std::chrono::milliseconds(250);
};

// How a run ended.
struct RunOutcome {
  RunStatus status = RunStatus::failed;
  std::string message;  // why it did not complete
  RunSummary summary;   // as written
  std::vector<ExpectationResult> expectations;

  bool as_expected() const;
};

// Carries out a run whose step, and whose boundary values if it has any, are known. All else is as run() says.
RunOutcome carry_out(const Experiment& experiment, RunKeeper& keeper, const RunOptions& options);
// The same from a start of it that is known: start_of_run(), or one that is as good.
RunOutcome carry_out(const Experiment& experiment, RunKeeper& keeper, const RunOptions& options,
                     const ConsistentStart& start);

}  // namespace courant
