// EventWatch: where quantities of a run pass through zero.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
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
    std::set<long> behind = {};     // events that set something at the last state
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
  // stops it; a run that it ended before it ends again.
  std::optional<RunEnd> watch(const RunMoment& moment) override;

  // What it has ended the run with.
  const std::optional<RunEnd>& end() const { return end_; }

  // A zero of an event that sets something: what comes after it in the step that was watched is to be made again,
  // from another state.
  struct Reset {
    std::size_t event;
    Step step;     // that ends there
    VectorXd row;  // what is measured there
  };
  // That of the step that was watched last, once: the first. Zeros behind it were not looked for.
  std::optional<Reset> take_reset() { return std::exchange(reset_, std::nullopt); }
  // Goes on behind a reset, where this is measured; the curve is that of the way on. Zeros that the jump itself passes,
  // and those at the same time, count at its time: if such an event sets something, it is the one that is returned.
  std::optional<Reset> go_on_behind(const Reset& reset, const VectorXd& row, Stepper& way);

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
  // A part of the step, 0 to 1, and the value of a quantity there.
  struct From {
    double s, value;
  };
  Zero locate(std::size_t event, From from, const RunMoment& moment);
  // Of the event that set something where the step begins: a part at whose end its quantity has the other sign than at
  // the end of the step. Nothing where it keeps its sign.
  std::optional<From> side_before(std::size_t event, const RunMoment& moment);
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
  std::optional<RunEnd> end_;
  std::optional<Reset> reset_;
};

}  // namespace courant
