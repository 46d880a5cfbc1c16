#include "courant/running/runner.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "courant/core/message.hpp"
#include "courant/integrators/ladder/ladder_watch.hpp"
#include "courant/running/consistent_start.hpp"
#include "courant/running/ladder_json.hpp"
#include "courant/running/observer.hpp"
#include "courant/running/quantity_statistics.hpp"
#include "courant/running/run_folder.hpp"
#include "courant/running/trajectory_writer.hpp"

namespace courant {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

const char* word(RunStatus status) {
  switch (status) {
    case RunStatus::completed:
      return "completed";
    case RunStatus::failed:
      return "failed";
    case RunStatus::interrupted:
      return "interrupted";
  }
  return "";
}

double per(double amount, double count) { return count > 0.0 ? amount / count : 0.0; }

class Run {
 public:
  Run(const Experiment& experiment, const RunOptions& options)
      : experiment_(experiment),
        options_(options),
        ladder_(consistent_start(experiment)),
        ladder_json_(ladder_json(ladder_, *experiment.model.system)),
        observer_(experiment, ladder_, options.backend) {
    if (observer_.constraint_count() == 0 && ladder_.verdict != Verdict::inconsistent)
      for (const std::string& pointer : experiment.expect.violations)
        throw ExperimentError(pointer,
                              "tests nothing: the system has no constraints, no equations in "
                              "coordinates and t alone; expected another expectation");
    if (experiment.time)
      for (const double moment : experiment.expect.times)
        moments_due_.emplace(*experiment.time->step_at(moment), moment);
  }

  RunOutcome operator()() {
    if (options_.on_ladder) options_.on_ladder(ladder_json_);
    const bool consistent = ladder_.verdict != Verdict::inconsistent;
    std::optional<PreparedMethod> method;
    if (consistent) {
      check_finite(ladder_.point);
      method = prepare();
    } else if (!experiment_.expect.inconsistent) {
      fail("The system is inconsistent near the initial values. " + ladder_.reason);
    }
    const RunFolder folder(options_.folder, options_.replace, experiment_.document);
    std::vector<std::string> columns = observer_.names();
    columns.resize(observer_.written_count());
    columns.insert(columns.begin(), "t");
    const auto writer = make_trajectory_writer(experiment_.output.format, folder.path(), columns);
    if (method)
      integrate(*method, *writer);
    else if (consistent)
      record(ladder_.point, 0, 0, *writer);
    writer->flush();

    RunOutcome outcome{status_, message_, {}, expectations()};
    outcome.summary = summary(outcome.expectations);
    folder.write_summary(outcome.summary);
    return outcome;
  }

 private:
  void fail(std::string message) {
    status_ = RunStatus::failed;
    message_ = std::move(message);
  }

  void check_finite(const State& state) {
    VectorXd row;
    try {
      row = observer_.row(state);
    } catch (const std::domain_error& error) {
      throw ExperimentError("/initial", without_place(error.what()));
    }
    for (Index i = 0; i < static_cast<Index>(observer_.written_count()); ++i)
      if (!std::isfinite(row[i]))
        throw ExperimentError("/initial", observer_.names()[static_cast<std::size_t>(i)] + " is " +
                                              number_text(row[i]) +
                                              " at the initial point; expected a finite number");
  }

  std::optional<PreparedMethod> prepare() {
    if (!experiment_.method) return std::nullopt;
    try {
      PreparedMethod method =
          experiment_.method->prepare({.system = experiment_.model.system,
                                       .ladder = ladder_,
                                       .initial = ladder_.point,
                                       .step = experiment_.time->step,
                                       .backend = options_.backend,
                                       .vocabulary = &experiment_.model.vocabulary});
      backend_ = method.integrator->is_native() ? "native" : "interpreter";
      return method;
    } catch (const std::invalid_argument& error) {
      throw ExperimentError("/method", without_place(error.what()));
    } catch (const std::runtime_error& error) {
      fail(without_place(error.what()));
    } catch (const std::domain_error& error) {
      fail((steps_ == 0 ? "/method: " : "") + without_place(error.what()));
    }
    return std::nullopt;
  }

  // A state of the run: its row, where rows are due, and what is kept of it.
  void record(const State& state, long k, long last, TrajectoryWriter& writer) {
    const double t = experiment_.time ? experiment_.time->time(k) : state.t;
    const VectorXd& row = observer_.row(state);
    statistics_.add(t, row);
    if (k % experiment_.output.every == 0 || k == last)
      writer.append(t, row.head(static_cast<Index>(observer_.written_count())));
    for (auto [due, end] = moments_due_.equal_range(k); due != end; ++due)
      for (std::size_t i = 0; i < observer_.names().size(); ++i)
        moments_[due->second][observer_.names()[i]] = row[static_cast<Index>(i)];
    steps_ = k;
  }

  void integrate(const PreparedMethod& method, TrajectoryWriter& writer) {
    const TimeSpan& time = *experiment_.time;
    std::unique_ptr<Stepper> stepper;
    const auto begin = Clock::now();
    auto shown = begin;
    std::optional<LadderWatch> watch;
    if (experiment_.examine > 0) watch.emplace(experiment_.model.system, ladder_);
    const auto still_holds = [&](const State& state, long k) {
      if (!watch || k % experiment_.examine != 0) return true;
      const std::string finding = watch->examine(state);
      if (!finding.empty()) fail("Stopped after step " + std::to_string(k) + ". " + finding);
      return finding.empty();
    };
    try {
      stepper = method.integrator->start(method.initial, time.step);
      record(stepper->state(), 0, time.steps, writer);
      still_holds(stepper->state(), 0);
      for (long k = 1; k <= time.steps; ++k) {
        if (options_.stop && options_.stop->load(std::memory_order_relaxed)) {
          status_ = RunStatus::interrupted;
          message_ = "Interrupted after step " + std::to_string(k - 1) + ".";
          break;
        }
        stepper->step();
        record(stepper->state(), k, time.steps, writer);
        if (!still_holds(stepper->state(), k)) break;
        if (!options_.on_progress) continue;
        if (const auto now = Clock::now();
            now - shown > std::chrono::milliseconds(100) || k == time.steps) {
          shown = now;
          options_.on_progress({k, time.steps, seconds_since(begin), energy_drift()});
        }
      }
    } catch (const SolveError& error) {
      fail(error.what() + (watch ? watch->decline() : ""));
    } catch (const std::domain_error& error) {
      fail((steps_ == 0 ? "/method: " : "") + without_place(error.what()));
    }
    wall_seconds_ = seconds_since(begin);
    if (stepper) solver_ = stepper->statistics();
  }

  std::optional<Index> energy() const {
    const auto& names = observer_.names();
    const auto found = std::find(names.begin(), names.end(), "H");
    return found == names.end() ? std::nullopt : std::optional(found - names.begin());
  }
  double energy_drift() const {
    const auto H = energy();
    if (!H) return std::numeric_limits<double>::quiet_NaN();
    const QuantityRecord record = statistics_.record(*H);
    return record.final - record.initial;
  }

  std::vector<ExpectationResult> expectations() const {
    RunRecord record;
    record.completed = status_ == RunStatus::completed && !statistics_.empty();
    record.moments = moments_;
    record.ladder = ladder_json_;
    if (!statistics_.empty()) {
      for (std::size_t i = 0; i < observer_.names().size(); ++i)
        record.quantities[observer_.names()[i]] = statistics_.record(static_cast<Index>(i));
      record.max_violation = max_violation();
    }
    std::vector<ExpectationResult> results;
    for (const auto& check : experiment_.expect.checks) results.push_back(check(record));
    return results;
  }

  // The greatest |constraint[i]|, NaN where there are none.
  double max_violation() const {
    double greatest = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 0; i < observer_.constraint_count(); ++i) {
      const auto record = statistics_.record(static_cast<Index>(observer_.first_constraint() + i));
      greatest = std::fmax(greatest, std::max(record.max, -record.min));
    }
    return greatest;
  }

  Json summary(const std::vector<ExpectationResult>& expectations) const {
    Json json{
        {"status", word(status_)},
        {"message", message_},
        {"title", experiment_.title},
        {"system", experiment_.model.description},
        {"method", experiment_.method ? experiment_.method->description : "constraint algorithm"},
        {"steps", steps_},
        {"time", Json::object()},
        {"final", Json::object()},
        {"observables", Json::object()},
        {"constraints", Json::object()},
        {"ladder", ladder_json_},
        {"expectations", Json::array()}};
    if (const auto& time = experiment_.time)
      json["time"] = {{"start", time->start}, {"end", time->time(steps_)}, {"step", time->step}};
    if (!statistics_.empty()) {
      for (std::size_t i = 0; i < observer_.first_constraint(); ++i) {
        const std::string& name = observer_.names()[i];
        const QuantityRecord record = statistics_.record(static_cast<Index>(i));
        if (i < observer_.coordinate_count()) {
          json["final"][name] = record.final;
          continue;
        }
        json["observables"][name] = {
            {"initial", record.initial}, {"final", record.final},         {"min", record.min},
            {"max", record.max},         {"max_drift", record.max_drift}, {"slope", record.slope}};
      }
      if (observer_.constraint_count() > 0) json["constraints"]["max_violation"] = max_violation();
    }
    for (const ExpectationResult& result : expectations)
      json["expectations"].push_back({{"description", result.description},
                                      {"passed", result.passed},
                                      {"value", result.value},
                                      {"bound", result.bound}});
    const auto steps = static_cast<double>(steps_);
    json["solver"] = {
        {"iterations_per_step", per(static_cast<double>(solver_.iterations), steps)},
        {"factorizations_per_step", per(static_cast<double>(solver_.factorizations), steps)},
        {"failures", solver_.failures}};
    json["backend"] = backend_;
    json["wall_seconds"] = wall_seconds_;
    json["steps_per_second"] = per(steps, wall_seconds_);
    return json;
  }

  const Experiment& experiment_;
  const RunOptions& options_;
  const ConstraintLadder ladder_;
  const Json ladder_json_;
  Observer observer_;
  std::multimap<long, double> moments_due_;

  RunStatus status_ = RunStatus::completed;
  std::string message_;
  QuantityStatistics statistics_;
  decltype(RunRecord::moments) moments_;
  long steps_ = 0;
  SolverStatistics solver_;
  std::string backend_ = "interpreter";
  double wall_seconds_ = 0.0;
};

}  // namespace

bool RunOutcome::as_expected() const {
  return std::all_of(expectations.begin(), expectations.end(),
                     [](const ExpectationResult& result) { return result.passed; });
}

RunOutcome run(const Experiment& experiment, const RunOptions& options) {
  return Run(experiment, options)();
}

}  // namespace courant
