// UnfinishedRun: a run that can go on, by its files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "courant/reading/experiment.hpp"
#include "courant/running/checkpoint.hpp"
#include "courant/running/locked_folder.hpp"

namespace courant {

// A run that can go on, and from where.
struct UnfinishedRun {
  std::string id;
  std::optional<Checkpoint> checkpoint;  // nothing: from the start, no epoch was reached
};

// The run in a folder that goes on with this experiment: one that was killed, interrupted or failed,
// or one that is complete when the experiment ends later. Reads, changes nothing.
//
// Throws UnusableFolder if there is no run, it is complete, or its files are not those that it
// wrote; ExperimentError, with all changes, if it was begun with another experiment.
UnfinishedRun unfinished_run(const std::filesystem::path& folder, const Experiment& experiment);

}  // namespace courant
