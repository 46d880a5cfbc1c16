// UnfinishedRun: what `run --resume` goes on with.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "courant/reading/experiment.hpp"
#include "courant/running/checkpoint.hpp"
#include "courant/running/locked_folder.hpp"

namespace courant {

// A run that did not reach its end, and the checkpoint that it goes on from.
struct UnfinishedRun {
  std::string id;
  // Nothing where the run ended before its first checkpoint: it begins anew.
  std::optional<Checkpoint> checkpoint;
};

// Reads from a folder the run that goes on with this experiment. That is a run that was killed, interrupted or failed,
// or a complete one if the experiment now ends at a later time. Changes no file.
//
// Throws UnusableFolder if the folder has no run, if its run is complete, or if its files are not as the run wrote
// them. Throws ExperimentError, which names all changes, if the run was begun with another experiment.
UnfinishedRun unfinished_run(const std::filesystem::path& folder, const Experiment& experiment);

}  // namespace courant
