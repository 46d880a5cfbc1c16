// Running an experiment.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "courant/reading/experiment.hpp"
#include "courant/running/run_watchers.hpp"

namespace courant {

struct RunOptions {
  std::filesystem::path folder;
  Backend backend = Backend::automatic;
  bool replace = false;                               // a run that is in the folder already
  const std::atomic<bool>* stop = nullptr;            // set by someone else: the run is interrupted
  std::function<void(const Json& ladder)> on_ladder;  // once the constraint algorithm has finished
  std::function<void(const Integrator&)> on_method = {};  // once it is made ready
  std::function<void(const Progress&)> on_progress;       // some ten times a second
  std::vector<RunWatcher*> watchers = {};                 // are told of every state too
};

struct RunOutcome {
  RunStatus status = RunStatus::failed;
  std::string message;  // why it did not complete
  Json summary;         // as written
  std::vector<ExpectationResult> expectations;

  bool as_expected() const;
};

// Starts at a consistent point, makes the method, steps, and writes trajectory, summary and
// experiment to the folder (the contract has the files). What the numerics cannot do is an outcome;
// everything up to then is on disk.
//
// Throws ExperimentError for initial values that cannot be used and UnusableFolder for a folder
// that cannot: then nothing was written. Throws OutputError when the disk is full later on.
RunOutcome run(const Experiment& experiment, const RunOptions& options);

}  // namespace courant
