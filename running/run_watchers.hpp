// The watchers that a run of an experiment has.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "courant/integrators/certificate/ladder_watch.hpp"
#include "courant/running/quantity_statistics.hpp"
#include "courant/running/run_watcher.hpp"

namespace courant {

// Where a run is, for whoever watches it.
struct Progress {
  long step = 0, steps = 0;
  long first = 0;             // the step that it began or went on after
  double seconds = 0.0;       // since then
  double energy_drift = 0.0;  // H - H(0); NaN without an energy
};

// What they are given has to outlive them.

std::unique_ptr<RunWatcher> keep_statistics(QuantityStatistics& statistics);

// The first value that is not finite among the first `count` of a row goes into `found`. `statistics`: of the same
// rows, which have been told of each before.
struct NotFinite {
  double t = 0.0, value = 0.0;
  Index column = 0;
};
std::unique_ptr<RunWatcher> find_not_finite(std::optional<NotFinite>& found, Index count,
                                            const QuantityStatistics& statistics);

// rows[t] becomes the row after step k for the pairs (k, t) in `due`.
std::unique_ptr<RunWatcher> keep_rows(std::multimap<long, double> due,
                                      std::map<double, VectorXd>& rows);

// Ends the run with what the watch finds at every `every`-th state.
std::unique_ptr<RunWatcher> examine_ladder(LadderWatch& watch, long every);

// Some ten times a second, and after the last step. `first` as in Progress.
std::unique_ptr<RunWatcher> show_progress(std::function<void(const Progress&)> show,
                                          std::function<double()> energy_drift, long first);

// Interrupts the run once `stop` is set.
std::unique_ptr<RunWatcher> stop_when(const std::atomic<bool>& stop);

}  // namespace courant
