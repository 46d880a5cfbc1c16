// What `courant run` does with an ensemble.
#pragma once

#include <filesystem>
#include <string>

#include "courant/cli/command.hpp"
#include "courant/running/ensemble_run.hpp"
#include "courant/running/run_folder.hpp"

namespace courant::cli {

// What `courant run` was asked for of an experiment with "ensemble".
struct EnsembleTask {
  std::string file;  // of the experiment, for messages
  std::filesystem::path folder;
  ExistingRun existing = ExistingRun::refuse;
  Backend backend = Backend::automatic;
  unsigned jobs = 0;  // threads; 0: as many as there are cores
  bool quiet = false;
};

// Runs the members on all cores, with a line of progress on a terminal, and shows how they are spread at the end. The
// exit status is 0 if all completed and came out as expected, 3 if not, 130 if it was interrupted.
int run_members(const Console& console, const EnsembleTask& task, const Experiment& experiment);

}  // namespace courant::cli
