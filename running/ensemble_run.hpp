// Running an ensemble.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "courant/core/expressions/backend.hpp"
#include "courant/core/numbers/parallel.hpp"
#include "courant/reading/experiment.hpp"
#include "courant/running/ensemble_member.hpp"
#include "courant/running/run_summary.hpp"

namespace courant {

// Where the members of an ensemble go: a folder (EnsembleFolder), memory. run_ensemble() calls these in the order of
// their declarations, append() for one member after the other in the order of their numbers, from one thread at a time.
class EnsembleKeeper {
 public:
  virtual ~EnsembleKeeper() = default;

  // Before anything is computed. Throws where the ensemble cannot be kept.
  virtual void check(const Experiment&) {}
  // From now on it is kept. `recall` is called with the members 0, 1, … that are there already.
  virtual void begin(const Experiment&, const EnsembleOpening&,
                     const std::function<void(const EnsembleMember&)>& recall) {
    static_cast<void>(recall);
  }
  virtual std::string id() const { return {}; }  // empty where it has none
  virtual void append(const EnsembleMember& member) = 0;
  // At the beginning and at the end, with the table of EnsembleStatistics::csv().
  virtual void tell(const Json& summary, const std::string& statistics) = 0;
};

// How an ensemble is run, and who is told of it.
struct EnsembleOptions {
  Backend backend = Backend::automatic;
  unsigned threads = core_count();
  const std::atomic<bool>* stop =
      nullptr;  // set by someone else: members that are not whole are left out
  std::function<void(const LadderReport&)> on_ladder = {};  // of the first start
  // After each member, from one thread at a time.
  std::function<void(Index done, Index members)> on_progress = {};
};

// How it ended.
struct EnsembleOutcome {
  RunStatus status = RunStatus::failed;
  std::string message = {};  // how many did not complete
  std::vector<std::string> problems =
      {};             // a line for each of the first of these, and of those with another ladder
  Json summary = {};  // as written
  // Those of the members, each the worst of all of them; then those of the ensemble.
  std::vector<ExpectationResult> expectations = {};

  bool as_expected() const;
};

// The most numbers, members × rows × columns, that an ensemble may have: 16 GB.
inline constexpr double kMostEnsembleNumbers = 2e9;

// Runs the members of an experiment's ensemble on all cores. Each starts at the consistent point of its own values, by
// a constraint algorithm of its own, and has the bits of its own run, whatever the number of members and of threads.
// One that cannot be run, or not to its end, is told of with its number and the reason, and stops no other one; so is
// one whose start has another ladder than the first one.
//
// Throws ExperimentError where no member can be run, and where they are more than kMostEnsembleNumbers; and as the
// keeper does. Then nothing was written.
EnsembleOutcome run_ensemble(const Experiment& experiment, EnsembleKeeper& keeper,
                             const EnsembleOptions& options = {});

// An ensemble as objects: a member has `opening.rows` rows, NaN where its run had ended.
struct EnsembleInMemory {
  EnsembleOpening opening = {};
  std::vector<double> values = {};  // members × rows × columns
  std::vector<RunStatus> statuses = {};
  std::vector<std::string> messages = {};
  EnsembleOutcome outcome = {};
};
EnsembleInMemory run_ensemble_in_memory(const Experiment& experiment,
                                        const EnsembleOptions& options = {});

}  // namespace courant
