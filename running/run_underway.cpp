#include "courant/running/run_underway.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <new>
#include <optional>

#include "courant/core/words/message.hpp"
#include "courant/integrators/certificate/ladder_watch.hpp"
#include "courant/integrators/methods/explicit_runge_kutta.hpp"
#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/running/boundary_run.hpp"
#include "courant/running/consistent_start.hpp"
#include "courant/running/energy_watch.hpp"
#include "courant/running/gradient_watch.hpp"
#include "courant/running/ladder_report.hpp"
#include "courant/running/left_constraints.hpp"
#include "courant/running/observer_elsewhere.hpp"
#include "courant/running/other_values.hpp"
#include "courant/running/run_backend.hpp"
#include "courant/running/run_clock.hpp"
#include "courant/running/run_failure.hpp"
#include "courant/running/run_jumps.hpp"
#include "courant/running/run_results.hpp"
#include "courant/running/run_steps.hpp"
#include "courant/running/run_watchers.hpp"
#include "courant/running/start_moves.hpp"
#include "courant/running/step_watch.hpp"
#include "courant/running/stopwatch.hpp"
#include "courant/running/symmetry_check.hpp"
#include "courant/running/tangent_of_run.hpp"
#include "courant/running/trajectory_rows.hpp"

namespace courant {
namespace {

// Fewer steps are made while a thread begins.
constexpr long kWorthAThread = 1000;

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
  RunUnderway(const Experiment& experiment, RunKeeper& keeper, const RunOptions& options,
              const ConsistentStart& start)
      : experiment_(experiment),
        keeper_(keeper),
        options_(options),
        backend_(worthwhile(options.backend, experiment, options.alike)),
        ladder_(start),
        ladder_report_(options.explains_start
                           ? report_of_start(experiment, ladder_)
                           : discrete_ladder_report(ladder_, *experiment.model.system)),
        symmetries_(check_symmetries(experiment, ladder_)),
        observer_(experiment, ladder_, backend_) {
    if (const StartMoves moves = start_moves(experiment, ladder_); !moves.warning.empty())
      results_.warnings.push_back(moves.warning);
    if (observer_.constraint_count() == 0 && ladder_.verdict != Verdict::inconsistent)
      for (const std::string& pointer : experiment.expect.violations)
        throw ExperimentError(pointer,
                              "tests nothing: the system has no constraints, no equations in "
                              "coordinates and t alone; expected another expectation");
  }

  RunOutcome operator()() {
    for (const auto& [where, what] : experiment_.remarks)
      results_.warnings.push_back(where + ": " + what);
    if (options_.on_ladder) options_.on_ladder(ladder_report_);
    const bool consistent = ladder_.verdict != Verdict::inconsistent;
    std::optional<PreparedMethod> method;
    if (is_unsolved(experiment_)) {
      fail("/boundary: " + experiment_.solution->reason);
    } else if (consistent) {
      require_finite(observer_, experiment_, ladder_.point);
      method = prepare();
    } else if (!experiment_.expect.inconsistent) {
      fail("The system is inconsistent near the initial values. " + ladder_.reason);
    }
    if (options_.on_begin) options_.on_begin();
    const Checkpoint* const checkpoint = keeper_.begin(experiment_);
    results_.id = keeper_.id();
    try {
      make(checkpoint, method, consistent);
    } catch (const RefusedOutput&) {  // of a run that goes on: nothing was written
      throw;
    } catch (const std::bad_alloc&) {
      fail(place_ + "takes more memory than there is");
    } catch (const std::domain_error& error) {
      fail(place_ + without_place(error.what()));
    } catch (const std::exception& error) {  // a full disk, an interrupt of the host
      fail(place_ + without_place(error.what()));
      try {
        conclude();
      } catch (const OutputError&) {  // there is no place for it either
      }
      throw;
    }
    return conclude();
  }

 private:
  // All that is kept, but the last summary.
  void make(const Checkpoint* checkpoint, const std::optional<PreparedMethod>& method,
            bool consistent) {
    const long first = checkpoint ? checkpoint->k : 0;
    if (method) watch_energy(*method);
    if (method && experiment_.time) watch_steps(*method);
    place_ = "/examine: ";
    watch_ladder();
    place_.clear();
    if (checkpoint) recall(*checkpoint);
    if (options_.on_resume && options_.existing == ExistingRun::resume)
      options_.on_resume(first, checkpoint && clock_.is_transformed() ? checkpoint->state.t
                                : experiment_.time ? experiment_.time->time(first)
                                                   : 0.0);
    keeper_.tell(results_.summary(RunStatus::running, {}));
    keeper_.open(opening(method));
    if (method && !experiment_.events.empty()) watch_events(checkpoint);
    make_watchers(first);
    if (method)
      integrate(*method, checkpoint);
    else if (consistent && first == 0)
      goes_on({.after = ladder_.point}, 0);
    keeper_.close();
  }

  RunOutcome conclude() {
    RunOutcome outcome{results_.status, results_.message, {}, results_.expectations()};
    outcome.summary = results_.summary(results_.status, outcome.expectations);
    keeper_.tell(outcome.summary);
    return outcome;
  }

  void fail(std::string message) {
    results_.status = RunStatus::failed;
    results_.message = std::move(message);
  }

  std::optional<PreparedMethod> prepare() {
    if (!experiment_.method) return std::nullopt;
    try {
      PreparedMethod method = experiment_.method->prepare(
          {.system = experiment_.model.system,
           .ladder = ladder_,
           .initial = ladder_.point,
           .step = experiment_.time->step,
           .backend = options_.engine ? backend_.with(options_.engine) : backend_,
           .vocabulary = &experiment_.model.vocabulary});
      require_engine_at_work(*method.integrator);
      results_.backend = method.integrator->is_native() ? "native" : "interpreter";
      results_.metric = method.metric;
      if (auto map = tangent_of_run(experiment_, ladder_, method))
        observer_.follow(*std::move(map));
      if (auto sensitivities = sensitivities_of_run(experiment_, ladder_, method))
        observer_.follow(*std::move(sensitivities));
      if (options_.on_method) options_.on_method(*method.integrator);
      return method;
    } catch (const ExperimentError&) {  // has its own place
      throw;
    } catch (const EngineStopped&) {  // nothing was written
      throw;
    } catch (const std::invalid_argument& error) {
      // What the equations do not have is no mistake of the file.
      if (ladder_.verdict == Verdict::regular || ladder_.verdict == Verdict::gauge)
        throw ExperimentError("/method", without_place(error.what()));
      fail("/method: " + without_place(error.what()));
    } catch (const std::runtime_error& error) {
      fail(without_place(error.what()));
    } catch (const std::domain_error& error) {
      fail((results_.steps == 0 ? "/method: " : "") + without_place(error.what()));
    }
    return std::nullopt;
  }

  // A run of an engine that has nothing to do would be one of this process.
  void require_engine_at_work(const Integrator& method) {
    if (!options_.engine) return;
    const std::string name = options_.engine->name();
    if (options_.engine->taken() == 0)
      throw ExperimentError(
          "/method", method.name() +
                         " solves no equations in a step, and these are what the engine " + name +
                         " takes; expected a method that is implicit here, or "
                         "no engine");
    results_.engine = {.name = name, .ranks = options_.engine->ranks()};
  }

  RunOpening opening(const std::optional<PreparedMethod>& method) const {
    RunOpening opening{.columns = rows_.column_names(),
                       .headings = rows_.headings(),
                       .events = {},
                       .event_columns = rows_.names(),
                       .ladder = ladder_,
                       .integrator = method ? method->integrator : nullptr};
    if (method)
      for (const Event& event : experiment_.events) opening.events.push_back(event.name);
    return opening;
  }

  // All that is told of the states of the run, in this order. What ends the run is told last.
  void make_watchers(long first) {
    watchers_.push_back(keep_statistics(results_.statistics));
    watchers_.push_back(find_not_finite(not_finite_, static_cast<Index>(observer_.written_count()),
                                        results_.statistics));
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

  // Whether the run goes on from this state, which is that after step k. `events_told`: those on the way to it.
  bool goes_on(const Step& step, long k, bool events_told = false) {
    const State& state = step.after;
    const double t = clock_.t(state, k);
    RunMoment moment{.k = k,
                     .steps = clock_.steps(k, t),
                     .t = t,
                     .row = k == 0 ? observer_.begin(state) : observer_.advance(step),
                     .step = step};
    std::optional<RunEnd> end;
    if (event_watch_) end = events_told ? event_watch_->end() : event_watch_->watch(moment);
    // Where an event stops the run, that is its last state.
    if (event_watch_ && event_watch_->stop()) {
      const EventWatch::Stop& stop = *event_watch_->stop();
      return tell_all({.k = k, .steps = k, .t = stop.t, .row = stop.row, .step = stop.step},
                      std::move(end));
    }
    if (clock_.is_transformed()) {
      if (rows_.has_tau()) moment.tau = clock_.tau();
      rows_.keep(t, moment.row);
    }
    return tell_all(moment, std::move(end));
  }

  // Whether the run goes on after all that watch it were told of this moment; `end`: why it ends all the
  // same.
  bool tell_all(const RunMoment& moment, std::optional<RunEnd> end) {
    results_.steps = moment.k;
    results_.t = moment.t;
    keeper_.see(moment);
    rows_.write(moment, keeper_, event_watch_ && event_watch_->stop());
    const auto tell = [&](RunWatcher& watcher) {
      if (auto its_end = watcher.watch(moment); its_end && !end) end = std::move(its_end);
    };
    for (const auto& watcher : watchers_) tell(*watcher);
    if (energy_watch_) tell(*energy_watch_);
    if (step_watch_) tell(*step_watch_);
    if (gradient_watch_) tell(*gradient_watch_);
    for (RunWatcher* watcher : options_.watchers) tell(*watcher);
    if (end) {
      results_.status = end->status;
      results_.message = end->message;
    }
    return !end && !clock_.is_last();
  }

  // Whether someone may ask what a step was evaluated at.
  bool is_told_whole() const {
    return observer_.needs_stages() ||
           std::ranges::any_of(options_.watchers, &RunWatcher::needs_stages);
  }

  // Whether something is measured within steps.
  bool looks_into_steps() const {
    return event_watch_ || !experiment_.output.at.empty() || clock_.is_transformed();
  }

  void watch_energy(const PreparedMethod& method) {
    const auto H = energy();
    if (!H) return;
    EnergyWatch::Columns columns{.energy = *H};
    if (observer_.account()) {
      columns.balance = column("balance");
      for (const char* name : {"supplied", "dissipated"})
        if (const auto place = column(name)) columns.through_ports.push_back(*place);
    }
    energy_watch_.emplace(
        method.integrator, [this, H = *H](const State& state) { return elsewhere_.row(state)[H]; },
        [this](const State& state) { return elsewhere_.energy_sizes(state); }, std::move(columns),
        method.initial);
  }

  // How far steps turn, of explicit methods alone: others solve equations, which have no solution where there is none.
  void watch_steps(const PreparedMethod& method) {
    gradient_watch_.emplace(method.integrator, method.initial);
    const auto* const explicit_method =
        dynamic_cast<const ExplicitRungeKutta*>(method.integrator.get());
    if (!explicit_method || experiment_.time->division) return;
    const auto M = experiment_.model.system->manifold();
    const Index N = M->ambient_dimension();
    const auto bundle = std::dynamic_pointer_cast<const CotangentBundle>(M);
    const Index positions = bundle ? bundle->base()->ambient_dimension() : N;
    step_watch_.emplace(method.integrator, std::vector<std::pair<Index, Index>>{
                                               {0, positions}, {positions, N - positions}});
  }

  void watch_events(const Checkpoint* from) {
    const std::vector<std::string> columns = rows_.names();
    event_watch_.emplace(
        experiment_.events, static_cast<Index>(observer_.first_event()), columns,
        experiment_.expect.occurrences,
        [this, count = std::ssize(columns)](const std::string& name, double t,
                                            const VectorXd& row) {
          keeper_.append_event(name, t, row.head(count));
        },
        from ? from->event_watch : std::nullopt);
    results_.event_watch = &*event_watch_;
  }

  void watch_ladder() {
    if (experiment_.examine > 0 && experiment_.time)
      ladder_watch_.emplace(experiment_.model.system, ladder_);
  }

  // All that is known of a run after step k, where `solver` and `watch` are those since it began
  // or went on.
  Checkpoint checkpoint(long k, const State& state, const Motion& motion,
                        const SolverStatistics& solver, const Stopwatch& watch) const {
    Checkpoint now{.run = results_.id,
                   .k = k,
                   .state = state,
                   .motion = motion,
                   .wall_seconds = results_.wall_seconds + watch.wall_seconds(),
                   .cpu_seconds = results_.cpu_seconds + watch.cpu_seconds(),
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

  void recall(const Checkpoint& checkpoint) {
    const QuantityStatistics::Memory& kept = checkpoint.statistics;
    std::vector<const VectorXd*> rows = {&kept.initial, &kept.final, &kept.min,
                                         &kept.max,     &kept.mean,  &kept.covariation};
    for (const auto& [time, row] : checkpoint.rows_at_times) rows.push_back(&row);
    for (const VectorXd* row : rows)
      if (row->size() != static_cast<Index>(observer_.names().size()))
        keeper_.refuse_checkpoint("has " + std::to_string(row->size()) + " quantities, expected " +
                                  std::to_string(observer_.names().size()) +
                                  " as the experiment has");
    try {
      observer_.recall(checkpoint.observed);
    } catch (const std::invalid_argument& error) {
      keeper_.refuse_checkpoint(without_place(error.what()));
    }
    results_.steps = checkpoint.k;
    results_.wall_seconds = checkpoint.wall_seconds;
    results_.cpu_seconds = checkpoint.cpu_seconds;
    results_.solver = checkpoint.solver;
    results_.statistics.recall(checkpoint.statistics);
    results_.rows_at_times = checkpoint.rows_at_times;
    not_finite_ = checkpoint.not_finite;
    results_.t = checkpoint.state.t;
    if (energy_watch_ && checkpoint.energy_watch) energy_watch_->recall(*checkpoint.energy_watch);
    if (ladder_watch_ && checkpoint.ladder_watch) ladder_watch_->recall(*checkpoint.ladder_watch);
  }

  // Whether nobody needs more of a step than where it ended.
  bool may_make_ahead() const {
    return options_.ahead && !is_told_whole() && !looks_into_steps() && !experiment_.time->division;
  }

  // All steps, or those after a checkpoint.
  void integrate(const PreparedMethod& method, const Checkpoint* from) {
    const TimeSpan& time = *experiment_.time;
    RunSteps::Start start{.state = method.initial, .nodes = nodes_of_run(experiment_)};
    if (from) start.k = from->k, start.state = from->state, start.motion = from->motion;
    const bool ahead = may_make_ahead() && time.steps - start.k >= kWorthAThread;
    RunSteps steps(*method.integrator, time, experiment_.output.epoch, std::move(start), ahead);
    if (!ahead) look_at(steps.stepper());
    const Stopwatch watch;
    bool has_engine = true;
    try {
      bool going = true;
      steps.begin();
      if (from)
        observer_.restart(from->state);
      else
        going = goes_on(steps.ended(), 0);
      while (going && steps.k() < time.steps) {
        std::optional<Step> jump = next(steps, *method.integrator);
        const bool is_reset = !jump && (jump = over_resets(steps, *method.integrator));
        if (jump) {
          going = goes_on(*jump, steps.k(), is_reset);
        } else {
          if (looks_into_steps()) look_into(steps);
          going = goes_on(is_told_whole() ? steps.stepper().last() : steps.ended(), steps.k());
        }
        if (!going || !steps.is_epoch_over()) continue;
        // What is not in the state is forgotten. The checkpoint is the same for those who made the steps
        // before and for those who begin with it.
        const Motion motion = steps.end_epoch();
        observer_.restart(steps.state());
        if (step_watch_) step_watch_->forget();
        keeper_.keep([&] {
          return checkpoint(steps.k(), steps.state(), motion, steps.statistics(), watch);
        });
      }
    } catch (const EngineStopped& error) {
      results_.status = RunStatus::interrupted;
      results_.message = error.what();
      has_engine = false;
    } catch (const SolveError& error) {
      fail(failure_in_words(error, experiment_, ladder_, steps.state()) +
           (ladder_watch_ ? ladder_watch_->decline() : examined_at(steps.state())));
    } catch (const std::domain_error& error) {
      fail((results_.steps == 0 ? "/method: " : "") + without_place(error.what()));
    }
    results_.wall_seconds += watch.wall_seconds();
    results_.cpu_seconds += watch.cpu_seconds();
    results_.solver = results_.solver + steps.statistics();
    if (!has_engine) return;  // what follows may make steps
    if (results_.status == RunStatus::completed && not_finite_) {
      results_.status = RunStatus::not_finite;
      results_.message = observer_.names()[static_cast<std::size_t>(not_finite_->column)] + " is " +
                         number_text(not_finite_->value) +
                         " at t = " + number_text(not_finite_->t) + ", and maybe later.";
    }
    if (energy_watch_ && !energy_watch_->finding().empty())
      results_.warnings.push_back(energy_watch_->finding());
    else if (results_.status == RunStatus::completed)
      warn_of_end(method, steps.state());
  }

  // Makes a step. Where it fails at a corner, a coordinate may have to jump there: what comes back then is the step
  // up to just before the corner, the jump, and the way on from there.
  std::optional<Step> next(RunSteps& steps, const Integrator& integrator) {
    try {
      steps.next();
      return std::nullopt;
    } catch (const SolveError&) {
      if (!experiment_.time->division || experiment_.time->division->corners.empty()) throw;
      std::optional<Step> jump = jumps_.over_corners(steps.state(), steps.k(), integrator);
      if (!jump) throw;
      steps.skip_to(jump->after);
      observer_.restart(jump->before);
      return jump;
    }
  }

  // The last step, where events in it set something.
  std::optional<Step> over_resets(RunSteps& steps, const Integrator& integrator) {
    if (!jumps_.are_set_by_events()) return std::nullopt;
    const Step whole = steps.stepper().last();
    elsewhere_.begin_step();
    std::optional<Step> jump =
        jumps_.over_resets(whole, steps.k(), integrator, *event_watch_,
                           [this](Stepper& stepper) { tell_parts_to(stepper); });
    if (!jump) return std::nullopt;
    // The curve of the next step is that of the run again.
    look_at(steps.stepper());
    steps.replace(jump->after);
    observer_.restart(jump->before);
    return jump;
  }

  void tell_parts_to(Stepper& stepper) const {
    if (observer_.account() || observer_.tangent_map() || observer_.sensitivities())
      stepper.tell_parts();
  }

  void look_at(Stepper& stepper) {
    tell_parts_to(stepper);
    if (event_watch_)
      event_watch_->set_curve(stepper, [this](const Step& part) -> const VectorXd& {
        return elsewhere_.row_within(part);
      });
  }

  void look_into(RunSteps& steps) {
    if (clock_.is_transformed()) clock_.end_step(steps.stepper(), steps.state(), steps.k());
    elsewhere_.begin_step();
    rows_.write_between(steps.stepper(), steps.k(), elsewhere_, keeper_);
  }

  // What an examination of the ladder between the start and a state says, where none was asked for.
  std::string examined_at(const State& state) const {
    constexpr Index most_coordinates = 200;
    if (state.x.size() > most_coordinates || results_.steps == 0) return "";
    try {
      LadderWatch watch(experiment_.model.system, ladder_);
      if (const std::string before = watch.examine(ladder_.point); !before.empty()) return "";
      const std::string finding = watch.examine(state);
      return finding.empty() ? watch.decline() : " " + finding;
    } catch (const std::runtime_error&) {  // nothing is known of the point
    } catch (const std::domain_error&) {
    }
    return "";
  }

  void warn_of_end(const PreparedMethod& method, const State& end) {
    const QuantityStatistics& all = results_.statistics;
    std::string warning = left_constraints(observer_, all, method.initial, end);
    if (warning.empty() && !clock_.is_transformed() && !experiment_.time->division)
      warning = kept_violation(*method.integrator, observer_, all, method.initial, end,
                               {.h = experiment_.time->step, .steps = results_.steps});
    if (warning.empty())
      warning = alternation(*method.integrator, observer_, all, end, experiment_.time->step,
                            clock_.is_transformed() ? nullptr : &ladder_);
    if (!warning.empty()) results_.warnings.push_back(std::move(warning));
  }

  std::optional<Index> column(const std::string& name) const {
    const auto& names = observer_.names();
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? std::nullopt : std::optional(found - names.begin());
  }
  std::optional<Index> energy() const { return column("H"); }
  double energy_drift() const {
    const auto H = energy();
    if (!H) return std::numeric_limits<double>::quiet_NaN();
    const QuantityRecord record = results_.statistics.record(*H);
    return record.final - record.initial;
  }

  const Experiment& experiment_;
  RunKeeper& keeper_;
  const RunOptions& options_;
  const Backend backend_;  // for the steps of the run
  const ConsistentStart ladder_;
  const LadderReport ladder_report_;
  const std::vector<SymmetryFinding> symmetries_;
  Observer observer_;
  ObserverElsewhere elsewhere_{experiment_, ladder_, observer_};

  RunResults results_{.experiment = experiment_,
                      .ladder = ladder_,
                      .ladder_report = ladder_report_,
                      .symmetries = symmetries_,
                      .observer = observer_};
  RunJumps jumps_{experiment_, observer_.first_reset(), elsewhere_, results_.warnings};
  std::string place_;  // in the experiment, of what is being made ready: "/examine: "
  std::optional<NotFinite> not_finite_;
  RunClock clock_{experiment_.time};
  std::optional<LadderWatch> ladder_watch_;
  std::optional<EnergyWatch> energy_watch_;
  std::optional<StepWatch> step_watch_;
  std::optional<GradientWatch> gradient_watch_;
  TrajectoryRows rows_{experiment_, observer_, clock_, results_.rows_at_times};
  std::optional<EventWatch> event_watch_;
  std::vector<std::unique_ptr<RunWatcher>> watchers_;
};

}  // namespace

bool RunOutcome::as_expected() const {
  return std::all_of(expectations.begin(), expectations.end(),
                     [](const ExpectationResult& result) { return result.passed; });
}

RunOutcome carry_out(const Experiment& experiment, RunKeeper& keeper, const RunOptions& options) {
  keeper.check(experiment);
  return RunUnderway(experiment, keeper, options, start_of_run(experiment))();
}

RunOutcome carry_out(const Experiment& experiment, RunKeeper& keeper, const RunOptions& options,
                     const ConsistentStart& start) {
  keeper.check(experiment);
  return RunUnderway(experiment, keeper, options, start)();
}

}  // namespace courant
