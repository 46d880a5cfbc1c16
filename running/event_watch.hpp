// EventWatch: where quantities of a run pass through zero.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "courant/core/files/content_hash.hpp"
#include "courant/integrators/step/stepper.hpp"
#include "courant/reading/event.hpp"
#include "courant/reading/expectation.hpp"
#include "courant/running/run_watcher.hpp"

namespace courant {

// Looks for events between two states of a run and tells of each, with its time and all that is
// measured there. Where a quantity has different signs at the two ends of a step, its
// zero is found on the curve of the step, Stepper::between, by bracketing: to round-off of the
// step, as right as the method is. Two zeros within one step are not seen, nor are those that touch
// zero without passing through it.
class EventWatch final : public RunWatcher {
 public:
  // What is measured where a part of the last step ends: columns as in the rows of the run.
  using Measure = std::function<const VectorXd&(const Step&)>;

  // An occurrence: the name of the event, its time, all that is measured there.
  using Tell = std::function<void(const std::string& name, double t, const VectorXd& row)>;

  // All that is kept of the states so far.
  struct Memory {
    VectorXd values = {};  // of the quantities at the last state
    std::map<std::string, EventRecord> records = {};
    HashedBytes::Record file = {};  // events.csv, where it is kept there
  };

  // `first`: the column of the first event. `columns`: names of those that records() has. `kept`:
  // which occurrences (1, 2, …) of an event are to be there. `memory`: that of the run that
  // goes on.
  EventWatch(std::vector<Event> events, Index first, std::vector<std::string> columns,
             std::map<std::string, std::set<long>> kept, Tell tell,
             std::optional<Memory> memory = std::nullopt);

  // Both have to outlive the run; before this is called no state may be watched.
  void set_curve(Stepper& stepper, Measure measure);

  // Ends the run as failed where a zero cannot be located, and as completed with a zero of an event that
  // stops it.
  std::optional<RunEnd> watch(const RunMoment& moment) override;

  // Where an event stopped the run, within the step that was watched last.
  struct Stop {
    std::string event;
    double t;
    VectorXd row;  // what is measured there
    Step step;     // that ends there
  };
  const std::optional<Stop>& stop() const { return stop_; }

  // By the names of the events: how often each occurred, and what was measured at the occurrences
  // that are kept, the time as "t".
  const std::map<std::string, EventRecord>& records() const { return memory_.records; }
  const Memory& memory() const { return memory_; }

 private:
  struct Zero {
    std::size_t event;
    double t;
    VectorXd row;
    Step part;  // of the step, up to there
  };
  Zero locate(std::size_t event, double before, const RunMoment& moment);
  void take(const Zero& zero);

  std::vector<Event> events_;
  Index first_;
  std::vector<std::string> columns_;
  std::map<std::string, std::set<long>> kept_;
  Tell tell_;
  Stepper* stepper_ = nullptr;
  Measure measure_;
  Memory memory_;
  std::optional<Stop> stop_;
};

}  // namespace courant
