// What an experiment expects of its run, and what is known of the run.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "courant/integrators/boundary/boundary_solution.hpp"
#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/reading/model.hpp"
#include "courant/reading/time_span.hpp"

namespace courant {

// A quantity along a run.
struct QuantityRecord {
  double initial = 0.0, final = 0.0, min = 0.0, max = 0.0;
  double max_drift = 0.0;  // greatest |value - initial|
  double slope = 0.0;  // of the least-squares line through (t, value): the drift per unit of time
};

// The occurrences of an event along a run.
struct EventRecord {
  long count = 0;
  double first = std::numeric_limits<double>::quiet_NaN();  // times
  double last = std::numeric_limits<double>::quiet_NaN();
  // Quantities at those that are asked for, by their number 1, 2, …; the time is "t".
  std::map<long, std::map<std::string, double, std::less<>>> occurrences = {};
};

// What is known of a run when its expectations are looked at.
struct RunRecord {
  bool completed = false;
  std::map<std::string, QuantityRecord, std::less<>>
      quantities;  // coordinates, observables, deviations
  std::map<double, std::map<std::string, double, std::less<>>>
      moments;                                                      // quantities at times asked for
  double max_violation = std::numeric_limits<double>::quiet_NaN();  // of the constraints, if any
  std::map<std::string, EventRecord> events;
  const ConstraintLadder* ladder = nullptr;    // null if not reached
  const BoundarySolution* boundary = nullptr;  // null if there is none
  // The greatest imbalances of a step, as of PowerAccount, if the system knows its powers.
  double max_imbalance = std::numeric_limits<double>::quiet_NaN();
  double max_stage_imbalance = std::numeric_limits<double>::quiet_NaN();
};

// What is known of an ensemble: how a quantity is spread over its members at a time, NaN where there are no rows.
struct EnsembleRecord {
  struct Spread {
    double mean = std::numeric_limits<double>::quiet_NaN();
    double standard_deviation = std::numeric_limits<double>::quiet_NaN();
  };
  std::function<Spread(const std::string& quantity, double t)> spread;
};

// One entry of `expectations` in a summary.
struct ExpectationResult {
  std::string pointer;  // of the entry of `expect`
  std::string description;
  bool passed = false;
  Json value;  // what is compared, a deviation where one is allowed; null where it is not known
  Json bound;
  std::string finding;  // in words: "is -0.2608, off by 0.415; allowed 1e-07"
};

// The entries of `expect`, and what a run has to keep for them.
struct Expectations {
  // |quantity - closed form in t|, which the record has under this name. The forms hold at every
  // step.
  struct Deviation {
    std::string name;
    std::string quantity;
    WrittenFormula form;
  };
  std::vector<double> times;
  std::map<std::string, std::set<long>> occurrences;  // of events
  std::vector<Deviation> deviations;
  std::vector<std::function<ExpectationResult(const RunRecord&)>> checks;
  // Of an ensemble as a whole; all others are of each of its members.
  std::vector<std::function<ExpectationResult(const EnsembleRecord&)>> ensemble_checks;
  bool inconsistent = false;  // the verdict that is expected, after which there is nothing to run
  bool imbalance = false;     // of energy has a bound
  std::vector<std::string> violations;  // pointers of bounds of constraints, which there must be
};

}  // namespace courant
