// Checkpoint: all there is to know of a run at an epoch.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "courant/core/files/content_hash.hpp"
#include "courant/integrators/certificate/ladder_watch.hpp"
#include "courant/integrators/step/stepper.hpp"
#include "courant/running/energy_watch.hpp"
#include "courant/running/event_watch.hpp"
#include "courant/running/observer.hpp"
#include "courant/running/quantity_statistics.hpp"
#include "courant/running/run_watchers.hpp"

namespace courant {

// A run after step k, just after the workspaces of method and observer have forgotten the steps
// before. A run of the same experiment that goes on from here makes the steps, rows and records
// that the run itself makes, to the last bit.
struct Checkpoint {
  std::string run;  // its id
  long k = 0;
  State state = {};
  Motion motion = {};  // that steps from the state go on with
  // So far:
  HashedBytes::Record trajectory = {};  // its file
  double wall_seconds = 0.0;
  double cpu_seconds = 0.0;
  SolverStatistics solver = {};
  QuantityStatistics::Memory statistics = {};
  std::map<double, VectorXd> rows_at_times = {};
  // Where there is such a thing:
  std::optional<NotFinite> not_finite = {};
  std::optional<EnergyWatch::Memory> energy_watch = {};
  std::optional<LadderWatch::Memory> ladder_watch = {};
  std::optional<EventWatch::Memory> event_watch = {};
  Observer::Memory observed = {};
};

// The file of a checkpoint: JSON, numbers by the fewest digits that read back to the same double.

// A kill at any moment leaves the file whole, the former or this. Throws OutputError.
void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint);

// Throws RunFileError, also where the file is no longer what was written, and where another version of
// Courant wrote it: that may make other bits.
Checkpoint read_checkpoint(const std::filesystem::path& file);

}  // namespace courant
