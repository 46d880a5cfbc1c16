// RunSummary: what a run says of itself.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "courant/reading/expectation.hpp"
#include "courant/running/ladder_report.hpp"
#include "courant/running/power_account.hpp"
#include "courant/running/run_watcher.hpp"

namespace courant {

// summary.json as a value. A number that is not known, or was not finite, is NaN.
struct RunSummary {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  std::string id = {};
  RunStatus status = RunStatus::running;
  std::string message = {};  // why it did not complete
  std::vector<std::string> warnings = {};
  std::string title = {}, system = {}, method = {};
  std::string metric =
      {};  // of the projector: "kinetic", "euclidean" or "given"; empty: nothing is projected
  long steps = 0;
  struct Time {
    double start = kUnknown, end = kUnknown, step = kUnknown;
  };
  std::optional<Time> time = {};
  std::string stopped_by = {};  // the event that ended it before its time
  std::vector<std::pair<std::string, double>> final = {};  // coordinates
  std::vector<std::pair<std::string, QuantityRecord>> observables = {};
  // What Noether's theorem says of the momentum of that name, which is an observable.
  struct Symmetry {
    bool is_conserved = false;
    std::string remark = {};  // why not
  };
  std::vector<std::pair<std::string, Symmetry>> symmetries = {};
  struct Event {
    long count = 0;
    double first = kUnknown, last = kUnknown;  // times
  };
  std::vector<std::pair<std::string, Event>> events = {};
  std::optional<double> max_violation = {};                // of constraints, where there are any
  std::optional<PowerAccount::Report> power_balance = {};  // where the account is kept
  std::optional<LadderReport> ladder = {};
  Json sensitivities = {};  // as RunSensitivities::summary() has it; null where none are asked for
  Json boundary = {};       // as boundary_summary() has it; null without conditions at both ends
  std::vector<ExpectationResult> expectations = {};
  struct Solver {
    double iterations_per_step = kUnknown, factorizations_per_step = kUnknown;
    std::optional<long> failures = {}, second_attempts = {}, confirmations = {}, divisions = {};
  };
  Solver solver = {};
  std::string backend = {};
  // What solved the equations of steps, and how many processes it is; nothing: this process.
  struct Engine {
    std::string name = {};
    long ranks = 1;
  };
  std::optional<Engine> engine = {};
  double wall_seconds = kUnknown, cpu_seconds = kUnknown, steps_per_second = kUnknown;

  // Nothing if there is none of this name. It lives as long as the summary.
  const QuantityRecord* observable(std::string_view name) const&;
  const QuantityRecord* observable(std::string_view name) const&& = delete;
};

// "completed", as summaries have it.
const char* to_string(RunStatus status);

// The text of the file as JSON, and back. What is missing in it, as in summaries of earlier versions,
// is not known. Throws std::invalid_argument, `/json/pointer: what it is`, for the first field that
// is required and missing, or mistyped.
Json to_json(const RunSummary& summary);
RunSummary read_run_summary(const Json& json);

}  // namespace courant
