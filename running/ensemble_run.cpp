#include "courant/running/ensemble_run.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <new>
#include <optional>
#include <set>
#include <utility>

#include "courant/core/words/message.hpp"
#include "courant/reading/ensemble_members.hpp"
#include "courant/running/ensemble_statistics.hpp"
#include "courant/running/run_in_memory.hpp"
#include "courant/running/stopwatch.hpp"

namespace courant {
namespace {

constexpr std::size_t kMostTold = 10;  // members with problems

// How many rows a run to the end writes.
Index row_count(const Experiment& experiment) {
  const TimeSpan& time = *experiment.time;
  const Output& output = experiment.output;
  if (output.at.empty())
    return time.steps / output.every + 1 + (time.steps % output.every == 0 ? 0 : 1);
  std::set<long> steps = {0, time.steps};
  std::set<double> between;
  for (const double t : output.at) {
    const long near = std::lround((t - time.start) / time.step);
    for (long k = near - 1; k <= near + 1; ++k) {
      if (k >= 0 && k <= time.steps && output.is_written(k, time)) steps.insert(k);
      for (const double other : output.between(k, time)) between.insert(other);
    }
  }
  return static_cast<Index>(steps.size() + between.size());
}

// "regular: (8, 6), (6, 6)"
std::string ladder_text(const std::optional<LadderReport>& ladder) {
  if (!ladder) return "";
  std::string text = to_string(ladder->verdict);
  const char* separator = ": ";
  const auto dimension = [](const std::optional<Index>& d) {
    return d ? std::to_string(*d) : std::string("-");
  };
  for (const LadderReport::Level& level : ladder->levels) {
    text += separator + ("(" + dimension(level.dim_S) + ", " + dimension(level.dim_M) + ")");
    separator = ", ";
  }
  return text;
}

EnsembleMember as_member(Index number, RunInMemory&& run) {
  const RunSummary& summary = run.outcome.summary;
  EnsembleMember member{.number = number,
                        .status = run.outcome.status,
                        .message = run.outcome.message,
                        .warning = summary.warnings.empty() ? "" : summary.warnings.front(),
                        .steps = summary.steps,
                        .max_violation = summary.max_violation.value_or(EnsembleMember::kUnknown),
                        .ladder = ladder_text(summary.ladder),
                        .expectations = std::move(run.outcome.expectations),
                        .rows = std::move(run.rows.values)};
  if (const QuantityRecord* H = summary.observable("H")) member.max_drift = H->max_drift;
  for (const auto& [name, table] : run.events) {
    const std::size_t width = table.names.size();
    for (std::size_t k = 0; k + width <= table.values.size(); k += width)
      member.events.emplace_back(
          name, std::vector<double>(table.values.begin() + static_cast<std::ptrdiff_t>(k),
                                    table.values.begin() + static_cast<std::ptrdiff_t>(k + width)));
  }
  std::ranges::stable_sort(member.events, {},
                           [](const auto& event) { return event.second.front(); });
  return member;
}

EnsembleMember failed_member(Index number, std::string message) {
  return {.number = number, .message = std::move(message)};
}

// The worst of what the members were found to be.
class WorstResults {
 public:
  void add(const EnsembleMember& member) {
    if (worst_.size() < member.expectations.size()) worst_.resize(member.expectations.size());
    for (std::size_t k = 0; k < member.expectations.size(); ++k) {
      ExpectationResult one = member.expectations[k];
      one.finding = "member " + std::to_string(member.number) + " " + one.finding;
      std::optional<ExpectationResult>& worst = worst_[k];
      if (!worst || (worst->passed && !one.passed) ||
          (worst->passed == one.passed && distance(one) > distance(*worst)))
        worst = std::move(one);
    }
  }
  // `missing`: members that have no results of their own, and no run to its end.
  std::vector<ExpectationResult> results(std::optional<Index> missing) const {
    std::vector<ExpectationResult> all;
    for (const auto& worst : worst_) {
      if (!worst) continue;
      all.push_back(*worst);
      all.back().description += ", every member";
      if (missing && all.back().passed) {
        all.back().passed = false;
        all.back().finding = "is not known of member " + std::to_string(*missing);
      }
    }
    return all;
  }

 private:
  static double distance(const ExpectationResult& result) {
    return result.value.is_number() ? std::abs(result.value.get<double>()) : 0.0;
  }
  std::vector<std::optional<ExpectationResult>> worst_;
};

class EnsembleUnderway {
 public:
  EnsembleUnderway(const Experiment& experiment, EnsembleKeeper& keeper,
                   const EnsembleOptions& options)
      : experiment_(experiment), keeper_(keeper), options_(options), members_(experiment) {}

  EnsembleOutcome operator()() {
    keeper_.check(experiment_);
    const Stopwatch watch;
    std::map<Index, EnsembleMember> first = first_members();
    if (first.empty()) return interrupted_before();
    require_room();
    statistics_.emplace(opening_);
    keeper_.begin(experiment_, opening_, [this](const EnsembleMember& member) { take(member); });
    const Index known = done_;
    steps_ = 0;
    keeper_.tell(summary(RunStatus::running), "");
    std::mutex mutex;
    std::map<Index, EnsembleMember> waiting;  // for those before them
    const auto append = [&](EnsembleMember member) {
      const std::scoped_lock lock(mutex);
      waiting.emplace(member.number, std::move(member));
      for (auto next = waiting.find(done_); next != waiting.end(); next = waiting.find(done_)) {
        take(next->second);
        keeper_.append(next->second);
        waiting.erase(next);
        if (options_.on_progress) options_.on_progress(done_, members_.count());
      }
    };
    in_parallel(static_cast<std::size_t>(members_.count() - known), options_.threads,
                [&](std::size_t k) {
                  const Index i = known + static_cast<Index>(k);
                  if (options_.stop && *options_.stop) return;
                  const auto there = first.find(i);
                  EnsembleMember member = there != first.end() ? std::move(there->second) : run(i);
                  if (member.status != RunStatus::interrupted) append(std::move(member));
                });
    wall_seconds_ = watch.wall_seconds();
    cpu_seconds_ = watch.cpu_seconds();
    return conclude();
  }

 private:
  RunInMemory run_of(Index i, bool is_first) const {
    RunInMemoryOptions options;
    options.run.backend = options_.backend;
    options.run.alike = members_.count();
    options.run.stop = options_.stop;
    options.run.ahead = false;  // the cores have work
    options.run.explains_start = is_first;
    if (is_first) options.run.on_ladder = options_.on_ladder;
    return run_in_memory(members_(i), options);
  }

  EnsembleMember run(Index i) const {
    try {
      return as_member(i, run_of(i, false));
    } catch (const ExperimentError& error) {
      return failed_member(i, error.problems().front().line());
    } catch (const std::bad_alloc&) {
      return failed_member(i, "takes more memory than there is");
    } catch (const std::runtime_error& error) {
      return failed_member(i, without_place(error.what()));
    } catch (const std::domain_error& error) {
      return failed_member(i, without_place(error.what()));
    }
  }

  // The members up to the first that can be run, which tells the columns. Empty where that was interrupted.
  std::map<Index, EnsembleMember> first_members() {
    std::map<Index, EnsembleMember> found;
    std::optional<ExperimentError> wrong;
    opening_.members = members_.count();
    for (Index i = 0; i < members_.count(); ++i) try {
        RunInMemory run = run_of(i, true);
        if (run.outcome.status == RunStatus::interrupted) return {};
        opening_.rows = std::max(row_count(experiment_), static_cast<Index>(run.rows.rows()));
        opening_.columns = run.rows.names;
        if (!run.events.empty()) opening_.event_columns = run.events.begin()->second.names;
        first_ = run.outcome.summary;
        first_number_ = i;
        found.emplace(i, as_member(i, std::move(run)));
        return found;
      } catch (const ExperimentError& error) {
        if (!wrong) wrong = error;
        found.emplace(i, failed_member(i, error.problems().front().line()));
      }
    std::vector<Problem> problems = wrong->problems();
    for (Problem& problem : problems) problem.what = "member 0: " + problem.what;
    throw ExperimentError(std::move(problems));
  }

  void require_room() const {
    const double numbers =
        static_cast<double>(opening_.members) * static_cast<double>(opening_.numbers_of_member());
    if (numbers <= kMostEnsembleNumbers) return;
    throw ExperimentError(
        "/ensemble", "has " + std::to_string(opening_.members) + " members × " +
                         std::to_string(opening_.rows) + " rows × " +
                         std::to_string(opening_.columns.size()) +
                         " columns = " + number_text(numbers, 3) + " numbers; expected at most " +
                         number_text(kMostEnsembleNumbers) +
                         ": fewer members, or rows by \"output\": {\"every\": …}");
  }

  // What is known of a member goes into what is known of all.
  void take(const EnsembleMember& member) {
    ++done_;
    steps_ += member.steps;
    statistics_->add(member);
    worst_.add(member);
    if (member.status != RunStatus::completed) {
      tell_of(member, member.message);
      if (!missing_ && member.expectations.empty()) missing_ = member.number;
    } else if (member.ladder != ladder_text(first_.ladder)) {
      tell_of(member, "its start has another ladder, " + member.ladder + "; that of member " +
                          std::to_string(first_number_) + " has " + ladder_text(first_.ladder));
      ++others_;
    }
    if (!member.warning.empty() && warned_++ == 0)
      warning_ = "member " + std::to_string(member.number) + ": " + member.warning;
  }

  void tell_of(const EnsembleMember& member, const std::string& what) {
    if (told_++ < kMostTold)
      problems_.push_back("member " + std::to_string(member.number) + ": " + what);
  }

  // The first problems of members, and how many are left out.
  std::vector<std::string> told() const {
    std::vector<std::string> lines = problems_;
    if (told_ > kMostTold)
      lines.push_back("and " + std::to_string(told_ - kMostTold) + " members more");
    return lines;
  }

  EnsembleOutcome conclude() {
    EnsembleOutcome outcome;
    const Index failures = done_ - statistics_->completed();
    if (done_ < members_.count()) {
      outcome.status = RunStatus::interrupted;
      outcome.message = "Interrupted after " + std::to_string(done_) + " of " +
                        std::to_string(members_.count()) + " members.";
    } else if (failures > 0) {
      outcome.status = RunStatus::failed;
      outcome.message =
          std::to_string(failures) + " of " + std::to_string(done_) + " members did not complete.";
    } else {
      outcome.status = RunStatus::completed;
    }
    outcome.problems = told();
    outcome.expectations = worst_.results(missing_);
    const EnsembleRecord record{[this](const std::string& quantity, double t) {
      const auto spread = statistics_->at(quantity, t);
      return spread ? EnsembleRecord::Spread{spread->mean, spread->standard_deviation()}
                    : EnsembleRecord::Spread{};
    }};
    for (const auto& check : experiment_.expect.ensemble_checks)
      outcome.expectations.push_back(check(record));
    outcome.summary = summary(outcome.status, outcome);
    keeper_.tell(outcome.summary, statistics_->csv());
    return outcome;
  }

  EnsembleOutcome interrupted_before() const {
    EnsembleOutcome outcome;
    outcome.status = RunStatus::interrupted;
    outcome.message = "Interrupted before the first member was done.";
    return outcome;
  }

  // As that of a run where it is about what a run has, with the members besides.
  Json summary(RunStatus status, const EnsembleOutcome& outcome = {}) const {
    RunSummary run{.id = keeper_.id(),
                   .status = status,
                   .message = outcome.message,
                   .warnings = told(),
                   .title = experiment_.title,
                   .system = first_.system,
                   .method = first_.method,
                   .metric = first_.metric,
                   .steps = experiment_.time->steps,
                   .ladder = first_.ladder,
                   .expectations = outcome.expectations,
                   .backend = first_.backend,
                   .wall_seconds = wall_seconds_,
                   .cpu_seconds = cpu_seconds_};
    if (warned_ > 0)
      run.warnings.push_back(warning_ + (warned_ == 1 ? ""
                                                      : " (" + std::to_string(warned_ - 1) +
                                                            " other members are warned of too)"));
    const TimeSpan& time = *experiment_.time;
    run.time = {.start = time.start, .end = time.end(), .step = time.step};
    const double violation = statistics_->max_violation();
    if (!std::isnan(violation)) run.max_violation = violation;
    Json json = to_json(run);
    json.erase("solver");
    json.erase("steps_per_second");
    json["members"] = members_.count();
    json["done"] = done_;
    json["completed"] = statistics_->completed();
    json["other_ladders"] = others_;
    json["rows"] = opening_.rows;
    json["columns"] = opening_.columns.size();
    const double rate = static_cast<double>(steps_) / cpu_seconds_;
    json["member_steps_per_cpu_second"] = std::isfinite(rate) ? Json(rate) : Json();
    json["drift"] = {{"H", statistics_->drift()}};
    json["statistics"] = statistics_->at_end();
    return json;
  }

  const Experiment& experiment_;
  EnsembleKeeper& keeper_;
  const EnsembleOptions& options_;
  const EnsembleMembers members_;
  EnsembleOpening opening_;
  RunSummary first_;  // of the first member that can be run
  Index first_number_ = 0;

  std::optional<EnsembleStatistics> statistics_;
  WorstResults worst_;
  Index done_ = 0, others_ = 0, warned_ = 0;
  long steps_ = 0;  // of the members that were not there before
  std::optional<Index> missing_;
  std::size_t told_ = 0;
  std::vector<std::string> problems_;
  std::string warning_;
  double wall_seconds_ = EnsembleMember::kUnknown, cpu_seconds_ = EnsembleMember::kUnknown;
};

class EnsembleMemory final : public EnsembleKeeper {
 public:
  explicit EnsembleMemory(EnsembleInMemory& result) : result_(result) {}

  void begin(const Experiment&, const EnsembleOpening& opening,
             const std::function<void(const EnsembleMember&)>&) override {
    result_.opening = opening;
  }
  void append(const EnsembleMember& member) override {
    const auto size = static_cast<std::size_t>(result_.opening.numbers_of_member());
    result_.values.insert(result_.values.end(), member.rows.begin(), member.rows.end());
    result_.statuses.push_back(member.status);
    result_.messages.push_back(member.message);
    result_.values.resize(result_.statuses.size() * size, EnsembleMember::kUnknown);
  }
  void tell(const Json&, const std::string&) override {}

 private:
  EnsembleInMemory& result_;
};

}  // namespace

bool EnsembleOutcome::as_expected() const {
  return std::ranges::all_of(expectations, &ExpectationResult::passed);
}

EnsembleOutcome run_ensemble(const Experiment& experiment, EnsembleKeeper& keeper,
                             const EnsembleOptions& options) {
  return EnsembleUnderway(experiment, keeper, options)();
}

EnsembleInMemory run_ensemble_in_memory(const Experiment& experiment,
                                        const EnsembleOptions& options) {
  EnsembleInMemory result;
  EnsembleMemory keeper(result);
  result.outcome = run_ensemble(experiment, keeper, options);
  return result;
}

}  // namespace courant
