#include "courant/running/runner.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <map>
#include <optional>

#include "courant/core/message.hpp"
#include "courant/integrators/ladder/ladder_watch.hpp"
#include "courant/running/checkpoint_keeper.hpp"
#include "courant/running/consistent_start.hpp"
#include "courant/running/energy_watch.hpp"
#include "courant/running/ladder_report.hpp"
#include "courant/running/left_constraints.hpp"
#include "courant/running/run_backend.hpp"
#include "courant/running/run_clock.hpp"
#include "courant/running/run_failure.hpp"
#include "courant/running/run_folder.hpp"
#include "courant/running/run_results.hpp"
#include "courant/running/run_watchers.hpp"
#include "courant/running/symmetry_check.hpp"
#include "courant/running/tangent_of_run.hpp"
#include "courant/running/trajectory_writer.hpp"

namespace courant {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

SolverStatistics operator+(const SolverStatistics& a, const SolverStatistics& b) {
  return {.steps = a.steps + b.steps,
          .iterations = a.iterations + b.iterations,
          .factorizations = a.factorizations + b.factorizations,
          .failures = a.failures + b.failures,
          .second_attempts = a.second_attempts + b.second_attempts,
          .confirmations = a.confirmations + b.confirmations,
          .divisions = a.divisions + b.divisions};
}

class RunUnderway {
 public:
  RunUnderway(const Experiment& experiment, const RunOptions& options)
      : experiment_(experiment),
        options_(options),
        backend_(worthwhile(options.backend, experiment)),
        ladder_(consistent_start(experiment)),
        ladder_report_(ladder_report(ladder_, *experiment.model.system)),
        symmetries_(check_symmetries(experiment, ladder_)),
        observer_(experiment, ladder_, backend_) {
    if (observer_.constraint_count() == 0 && ladder_.verdict != Verdict::inconsistent)
      for (const std::string& pointer : experiment.expect.violations)
        throw ExperimentError(pointer,
                              "tests nothing: the system has no constraints, no equations in "
                              "coordinates and t alone; expected another expectation");
  }

  RunOutcome operator()() {
    if (options_.on_ladder) options_.on_ladder(ladder_report_);
    const bool consistent = ladder_.verdict != Verdict::inconsistent;
    std::optional<PreparedMethod> method;
    if (consistent) {
      require_finite(observer_, experiment_, ladder_.point);
      method = prepare();
    } else if (!experiment_.expect.inconsistent) {
      fail("The system is inconsistent near the initial values. " + ladder_.reason);
    }
    const RunFolder folder(options_.folder, options_.existing, experiment_);
    results_.id = folder.id();
    const auto checkpoint = folder.checkpoint();
    const long first = checkpoint ? checkpoint->k : 0;
    if (method) watch_energy(*method);
    watch_ladder();
    if (checkpoint) recall(*checkpoint, folder);
    if (options_.on_resume && options_.existing == ExistingRun::resume)
      options_.on_resume(first, checkpoint && clock_.is_transformed() ? checkpoint->state.t
                                : experiment_.time ? experiment_.time->time(first)
                                                   : 0.0);
    folder.write_summary(results_.summary(RunStatus::running, {}));
    writer_ = make_writer(folder);
    if (method && !experiment_.events.empty()) watch_events(folder);
    make_watchers(first);
    CheckpointKeeper keeper(folder.checkpoint_file(), *writer_, options_.checkpoint_interval);
    if (method)
      integrate(*method, checkpoint, keeper);
    else if (consistent && first == 0)
      goes_on({.after = ladder_.point}, 0);
    writer_->flush();
    keeper.flush();

    RunOutcome outcome{results_.status, results_.message, {}, results_.expectations()};
    outcome.summary = results_.summary(results_.status, outcome.expectations);
    folder.write_summary(outcome.summary);
    return outcome;
  }

 private:
  // The column of the transformed time, unless the experiment has another use for the name.
  bool writes_tau() const {
    const auto& names = observer_.names();
    const auto end = names.begin() + static_cast<std::ptrdiff_t>(observer_.written_count());
    return clock_.is_transformed() && std::find(names.begin(), end, "tau") == end;
  }

  void fail(std::string message) {
    results_.status = RunStatus::failed;
    results_.message = std::move(message);
  }

  std::optional<PreparedMethod> prepare() {
    if (!experiment_.method) return std::nullopt;
    try {
      PreparedMethod method =
          experiment_.method->prepare({.system = experiment_.model.system,
                                       .ladder = ladder_,
                                       .initial = ladder_.point,
                                       .step = experiment_.time->step,
                                       .backend = backend_,
                                       .vocabulary = &experiment_.model.vocabulary});
      results_.backend = method.integrator->is_native() ? "native" : "interpreter";
      if (auto map = tangent_of_run(experiment_, ladder_, method))
        observer_.follow(*std::move(map));
      if (options_.on_method) options_.on_method(*method.integrator);
      return method;
    } catch (const ExperimentError&) {  // has its own place
      throw;
    } catch (const std::invalid_argument& error) {
      throw ExperimentError("/method", without_place(error.what()));
    } catch (const std::runtime_error& error) {
      fail(without_place(error.what()));
    } catch (const std::domain_error& error) {
      fail((results_.steps == 0 ? "/method: " : "") + without_place(error.what()));
    }
    return std::nullopt;
  }

  // Of the quantities in a row of the trajectory.
  std::vector<std::string> written_names() const {
    std::vector<std::string> names = observer_.names();
    names.resize(observer_.written_count());
    return names;
  }

  // The numbers of a row that the trajectory has.
  std::vector<Index> written_columns() const {
    std::vector<Index> columns;
    for (std::size_t i = 0; i < observer_.written_count(); ++i)
      if (i >= observer_.coordinate_count() || experiment_.output.has_column(observer_.names()[i]))
        columns.push_back(static_cast<Index>(i));
    return columns;
  }

  std::unique_ptr<TrajectoryWriter> make_writer(const RunFolder& folder) const {
    std::vector<std::string> columns = {"t"};
    if (writes_tau()) columns.push_back("tau");
    for (const Index i : columns_)
      columns.push_back(observer_.names()[static_cast<std::size_t>(i)]);
    for (std::string& column : columns) column = experiment_.output.heading(column);
    std::optional<std::uintmax_t> keep;
    if (folder.checkpoint()) keep = folder.checkpoint()->trajectory_size;
    return make_trajectory_writer(experiment_.output.format, folder.path(), columns, keep);
  }

  // All that is told of the states of the run, in this order. What ends the run is told last.
  void make_watchers(long first) {
    watchers_.push_back(keep_statistics(results_.statistics));
    watchers_.push_back(write_rows(
        *writer_,
        [this](long k) {
          return !experiment_.time || clock_.is_last() ||
                 experiment_.output.is_written(k, *experiment_.time);
        },
        columns_));
    watchers_.push_back(
        find_not_finite(not_finite_, static_cast<Index>(observer_.written_count())));
    if (experiment_.time && !clock_.is_transformed() && !experiment_.expect.times.empty()) {
      std::multimap<long, double> due;
      for (const double moment : experiment_.expect.times)
        due.emplace(*experiment_.time->step_at(moment), moment);
      watchers_.push_back(keep_rows(std::move(due), results_.rows_at_times));
    }
    if (options_.on_progress && experiment_.time)
      watchers_.push_back(show_progress(
          options_.on_progress, [this] { return energy_drift(); }, first));
    if (ladder_watch_) watchers_.push_back(examine_ladder(*ladder_watch_, experiment_.examine));
    if (options_.stop) watchers_.push_back(stop_when(*options_.stop));
  }

  // Whether the run goes on from this state, which is that after step k.
  bool goes_on(const Step& step, long k) {
    const State& state = step.after;
    const double t = clock_.t(state, k);
    RunMoment moment{.k = k,
                     .steps = clock_.steps(k, t),
                     .t = t,
                     .row = k == 0 ? observer_.begin(state) : observer_.advance(step),
                     .step = step};
    if (clock_.is_transformed()) {
      if (writes_tau()) moment.tau = clock_.tau();
      keep_expected(t, moment.row);
    }
    results_.steps = k;
    results_.t = t;
    std::optional<RunEnd> end;
    const auto tell = [&](RunWatcher& watcher) {
      if (auto its_end = watcher.watch(moment); its_end && !end) end = std::move(its_end);
    };
    for (const auto& watcher : watchers_) tell(*watcher);
    if (energy_watch_) tell(*energy_watch_);
    if (event_watch_) tell(*event_watch_);
    for (RunWatcher* watcher : options_.watchers) tell(*watcher);
    if (end) {
      results_.status = end->status;
      results_.message = end->message;
    }
    return !end && !clock_.is_last();
  }

  // A row that expectations ask for by its time.
  void keep_expected(double t, const VectorXd& row) {
    for (const double moment : experiment_.expect.times)
      if (moment == t) results_.rows_at_times[moment] = row;
  }

  // What is measured at states that other steps lead to has an observer of its own, made when it is
  // needed.
  const VectorXd& row_elsewhere(const State& state) {
    elsewhere(state);
    return elsewhere_->row(state);
  }
  // What was observed before the step that was made, where something is measured within steps.
  void keep_observed() {
    if (!event_watch_ && experiment_.output.at.empty() && !clock_.is_transformed()) return;
    observed_before_ = observer_.memory();
  }
  // At the end of a part of that step, with the energies and the tangent map up to there.
  const VectorXd& row_within(const Step& part) {
    elsewhere(part.after);
    elsewhere_->recall(observed_before_);
    return elsewhere_->advance(part);
  }
  void elsewhere(const State& state) {
    if (!elsewhere_) {
      elsewhere_.emplace(experiment_, ladder_, Backend::interpreter);
      if (const TangentMap* map = observer_.tangent_map()) elsewhere_->follow(*map);
    }
    elsewhere_->restart(state);
  }

  // In transformed time, what is asked for by its time in the step that was made, step k: rows of the
  // trajectory, and those that expectations ask for. Those at its end are told by goes_on.
  void visit_times(Stepper& stepper, long k) {
    const TimeSpan& time = *experiment_.time;
    const double before = stepper.last().before.t;
    const double after = clock_.is_last() ? time.until : stepper.last().after.t;
    std::map<double, bool> moments;  // whether they are written
    for (const double t : experiment_.expect.times) moments[t] = false;
    for (const double t : experiment_.output.at) moments[t] = true;
    for (const auto& [t, is_written] : moments) {
      if (!(t > before && (t < after || (t == after && is_written && !clock_.is_last())))) continue;
      const double share = stepper.share_at(std::min(t, stepper.last().after.t));
      const VectorXd& row = row_within(stepper.part(share));
      keep_expected(t, row);
      if (!is_written) continue;
      const double tau = time.time(k - 1) + share * stepper.last().h;
      append_row(*writer_, t, writes_tau() ? std::optional(tau) : std::nullopt, row(columns_));
    }
  }

  // The rows that are asked for between step k - 1 and the one that was made, step k.
  void write_between(Stepper& stepper, long k) {
    if (clock_.is_transformed()) return visit_times(stepper, k);
    if (experiment_.output.at.empty()) return;
    const TimeSpan& time = *experiment_.time;
    for (const double t : experiment_.output.between(k, time)) {
      const VectorXd& row = row_within(stepper.part((t - time.time(k - 1)) / time.step));
      writer_->append(t, row(columns_));
    }
  }

  void watch_energy(const PreparedMethod& method) {
    if (const auto H = energy())
      energy_watch_.emplace(
          method.integrator, [this, H = *H](const State& state) { return row_elsewhere(state)[H]; },
          [this](const State& state) {
            elsewhere(state);
            return elsewhere_->energy_terms(state);
          },
          *H, method.initial);
  }

  void watch_events(const RunFolder& folder) {
    std::optional<EventWatch::Memory> memory;
    if (folder.checkpoint()) memory = folder.checkpoint()->event_watch;
    event_watch_.emplace(experiment_.events, static_cast<Index>(observer_.first_event()),
                         written_names(), experiment_.expect.occurrences, folder.path(),
                         std::move(memory));
    results_.event_watch = &*event_watch_;
  }

  void watch_ladder() {
    if (experiment_.examine > 0 && experiment_.time)
      ladder_watch_.emplace(experiment_.model.system, ladder_);
  }

  // All that is known of a run after step k, where `solver` and `seconds` are those since it began
  // or went on.
  Checkpoint checkpoint(long k, const State& state, const Motion& motion,
                        const SolverStatistics& solver, double seconds) const {
    Checkpoint now{.run = results_.id,
                   .k = k,
                   .state = state,
                   .motion = motion,
                   .trajectory_size = writer_->size(),
                   .wall_seconds = results_.wall_seconds + seconds,
                   .solver = results_.solver + solver,
                   .statistics = results_.statistics.memory(),
                   .rows_at_times = results_.rows_at_times,
                   .not_finite = not_finite_,
                   .observed = observer_.memory()};
    if (energy_watch_) now.energy_watch = energy_watch_->memory();
    if (ladder_watch_) now.ladder_watch = ladder_watch_->memory();
    if (event_watch_) now.event_watch = event_watch_->memory();
    return now;
  }

  void recall(const Checkpoint& checkpoint, const RunFolder& folder) {
    const QuantityStatistics::Memory& kept = checkpoint.statistics;
    std::vector<const VectorXd*> rows = {&kept.initial, &kept.final, &kept.min,
                                         &kept.max,     &kept.mean,  &kept.covariation};
    for (const auto& [time, row] : checkpoint.rows_at_times) rows.push_back(&row);
    for (const VectorXd* row : rows)
      if (row->size() != static_cast<Index>(observer_.names().size()))
        throw UnusableFolder(folder.checkpoint_file().string() + ": has " +
                             std::to_string(row->size()) + " quantities, expected " +
                             std::to_string(observer_.names().size()) + " as the experiment has");
    try {
      observer_.recall(checkpoint.observed);
    } catch (const std::invalid_argument& error) {
      throw UnusableFolder(folder.checkpoint_file().string() + ": " + without_place(error.what()));
    }
    results_.steps = checkpoint.k;
    results_.wall_seconds = checkpoint.wall_seconds;
    results_.solver = checkpoint.solver;
    results_.statistics.recall(checkpoint.statistics);
    results_.rows_at_times = checkpoint.rows_at_times;
    not_finite_ = checkpoint.not_finite;
    results_.t = checkpoint.state.t;
    if (energy_watch_ && checkpoint.energy_watch) energy_watch_->recall(*checkpoint.energy_watch);
    if (ladder_watch_ && checkpoint.ladder_watch) ladder_watch_->recall(*checkpoint.ladder_watch);
  }

  // What is not in the state is forgotten. The checkpoint is the same for those who made the steps
  // before and for those who begin with it.
  void begin_epoch(Stepper& stepper, const State& state, const Motion& motion) {
    stepper.forget();
    stepper.expect(motion);
    observer_.restart(state);
  }

  // All steps, or those after a checkpoint.
  void integrate(const PreparedMethod& method, const std::optional<Checkpoint>& from,
                 CheckpointKeeper& keeper) {
    const TimeSpan& time = *experiment_.time;
    const long epoch = experiment_.output.epoch;
    const auto stepper = method.integrator->stepper();
    if (observer_.account() || observer_.tangent_map()) stepper->tell_parts();
    State state = from ? from->state : method.initial;
    long k = from ? from->k : 0;
    if (event_watch_)
      event_watch_->set_curve(
          *stepper, [this](const Step& part) -> const VectorXd& { return row_within(part); });
    const auto begin = Clock::now();
    try {
      bool going = true;
      if (from) {
        begin_epoch(*stepper, state, from->motion);
      } else {
        stepper->prepare(state, time.step);
        going = goes_on(stepper->last(), 0);
      }
      while (going && k < time.steps) {
        const long end = time.steps - k > epoch ? k + epoch : time.steps;
        for (; going && k < end; ++k) {
          stepper->step(state, time.step, time.time(k + 1));
          if (clock_.is_transformed()) clock_.end_step(*stepper, state, k + 1);
          keep_observed();
          write_between(*stepper, k + 1);
          going = goes_on(stepper->last(), k + 1);
        }
        if (!going || k == time.steps) break;
        const Motion motion = stepper->motion();
        begin_epoch(*stepper, state, motion);
        keeper.keep(checkpoint(k, state, motion, stepper->statistics(), seconds_since(begin)));
      }
    } catch (const SolveError& error) {
      fail(failure_in_words(error, experiment_, ladder_, state) +
           (ladder_watch_ ? ladder_watch_->decline() : ""));
    } catch (const std::domain_error& error) {
      fail((results_.steps == 0 ? "/method: " : "") + without_place(error.what()));
    }
    results_.wall_seconds += seconds_since(begin);
    results_.solver = results_.solver + stepper->statistics();
    if (results_.status == RunStatus::completed && not_finite_) {
      results_.status = RunStatus::not_finite;
      results_.message = observer_.names()[static_cast<std::size_t>(not_finite_->column)] + " is " +
                         number_text(not_finite_->value) +
                         " at t = " + number_text(not_finite_->t) + ", and maybe later.";
    }
    if (energy_watch_ && !energy_watch_->finding().empty())
      results_.warnings.push_back(energy_watch_->finding());
    else if (results_.status == RunStatus::completed)
      warn_of_end(method, state);
  }

  void warn_of_end(const PreparedMethod& method, const State& end) {
    const QuantityStatistics& all = results_.statistics;
    std::string warning = left_constraints(observer_, all, method.initial, end);
    if (warning.empty())
      warning = alternation(*method.integrator, observer_, all, end, experiment_.time->step);
    if (!warning.empty()) results_.warnings.push_back(std::move(warning));
  }

  std::optional<Index> energy() const {
    const auto& names = observer_.names();
    const auto found = std::find(names.begin(), names.end(), "H");
    return found == names.end() ? std::nullopt : std::optional(found - names.begin());
  }
  double energy_drift() const {
    const auto H = energy();
    if (!H) return std::numeric_limits<double>::quiet_NaN();
    const QuantityRecord record = results_.statistics.record(*H);
    return record.final - record.initial;
  }

  const Experiment& experiment_;
  const RunOptions& options_;
  const Backend backend_;  // for the steps of the run
  const ConstraintLadder ladder_;
  const LadderReport ladder_report_;
  const std::vector<SymmetryFinding> symmetries_;
  Observer observer_;
  const std::vector<Index> columns_ = written_columns();

  RunResults results_{.experiment = experiment_,
                      .ladder = ladder_,
                      .ladder_report = ladder_report_,
                      .symmetries = symmetries_,
                      .observer = observer_};
  std::optional<NotFinite> not_finite_;
  RunClock clock_{experiment_.time};
  std::optional<LadderWatch> ladder_watch_;
  std::optional<EnergyWatch> energy_watch_;
  std::unique_ptr<TrajectoryWriter> writer_;
  std::optional<Observer> elsewhere_;
  Observer::Memory observed_before_;  // the step that was made
  std::optional<EventWatch> event_watch_;
  std::vector<std::unique_ptr<RunWatcher>> watchers_;
};

}  // namespace

bool RunOutcome::as_expected() const {
  return std::all_of(expectations.begin(), expectations.end(),
                     [](const ExpectationResult& result) { return result.passed; });
}

RunOutcome run(const Experiment& experiment, const RunOptions& options) {
  RunFolder::check(options.folder, options.existing, experiment);
  return RunUnderway(experiment, options)();
}

}  // namespace courant
