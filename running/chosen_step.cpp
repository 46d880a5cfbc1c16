#include "courant/running/chosen_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "courant/core/words/message.hpp"
#include "courant/running/consistent_start.hpp"
#include "courant/running/run_keeper.hpp"
#include "courant/running/run_underway.hpp"

namespace courant {
namespace {

constexpr double kMostStepsTried = 1e6;
// An estimate that is more than this part of that with a longer step has not fallen; so many of them are tried.
constexpr double kFalls = 0.8;
constexpr int kMostInVain = 2;
constexpr double kNoEstimate = std::numeric_limits<double>::infinity();
// Ways of coordinates below this part of their greatest value are round-off.
constexpr double kLeastWayCompared = 1e-9;

// What a trial leaves: the coordinates at the ends of the longest steps, as columns, and those at which an event stopped it;
// and when events stopped it or set something, by their names.
struct Trial {
  MatrixXd x = {};
  std::map<std::string, std::vector<double>> jumps = {};
  VectorXd stopped_at = {};  // empty where no event did
  double last_time = 0.0;
  // From where a step could not be made to the end of that step.
  std::optional<std::pair<double, double>> failed_in = std::nullopt;
};

// Whether steps by themselves do not know how the run goes on behind it.
bool ends_a_way(const Event& event) { return event.sets() || event.stops; }

// Keeps of a run what a trial leaves, of every so many steps.
class TrialKeeper final : public RunKeeper {
 public:
  TrialKeeper(long parts, const TimeSpan& time) : parts_(parts), time_(time) {}

  void open(const RunOpening&) override {}
  void append(double, const std::optional<double>&, const Eigen::Ref<const VectorXd>&) override {}
  void append_event(const std::string& name, double t, const Eigen::Ref<const VectorXd>&) override {
    events_[name].push_back(t);
  }
  void see(const RunMoment& moment) override {
    constexpr double round_off = 1e-9;
    const double end = time_.time(moment.k / parts_);
    if (!moment.step.after.x.allFinite()) return;
    last_ = moment.step.after.x;
    last_t_ = moment.t;
    // An event may have stopped the run within the step.
    if (moment.k % parts_ == 0 && std::fabs(moment.t - end) <= round_off * std::fabs(time_.step))
      states_.push_back(last_);
  }
  void close() override {}
  void tell(const RunSummary&) override {}

  Trial trial(const std::vector<Event>& events) const {
    Trial trial{.x = MatrixXd(last_.size(), std::ssize(states_)), .last_time = last_t_};
    for (Index k = 0; k < trial.x.cols(); ++k)
      trial.x.col(k) = states_[static_cast<std::size_t>(k)];
    for (const Event& event : events) {
      if (!ends_a_way(event)) continue;
      const auto found = events_.find(event.name);
      const std::vector<double> times =
          found == events_.end() ? std::vector<double>() : found->second;
      if (event.stops && !times.empty()) trial.stopped_at = last_;
      trial.jumps[event.name] = times;
    }
    return trial;
  }

 private:
  long parts_;
  const TimeSpan& time_;
  std::vector<VectorXd> states_;
  VectorXd last_;
  double last_t_ = time_.start;
  std::map<std::string, std::vector<double>> events_;
};

// Runs with steps that are tried.
class Trials {
 public:
  Trials(const Experiment& experiment, Backend backend, const std::atomic<bool>* stop)
      : experiment_(experiment),
        backend_(backend),
        stop_(stop),
        // Boundary values are sought after a step is chosen, of one smooth map.
        jumps_(!experiment.boundary && std::ranges::any_of(experiment.events, ends_a_way)) {
    if (!jumps_) start_ = consistent_start(experiment);
  }

  Trial run(long parts) const {
    const TimeSpan& time = *experiment_.time;
    const double h = time.step / static_cast<double>(parts);
    Trial trial = jumps_ ? with_events(h, parts) : steps_alone(h, parts);
    if (trial.x.cols() <= time.steps && trial.stopped_at.size() == 0)
      trial.failed_in = {trial.last_time, trial.last_time + h};
    return trial;
  }

 private:
  Trial with_events(double h, long parts) const {
    const TimeSpan& time = *experiment_.time;
    const auto whole = with_chosen_step(experiment_, {.step = h});
    TrialKeeper keeper(parts, time);
    RunOptions options;
    options.backend = backend_;
    options.stop = stop_;
    options.explains_start = false;
    const RunOutcome outcome = carry_out(*whole, keeper, options);
    if (outcome.status == RunStatus::interrupted) throw std::runtime_error("interrupted");
    return keeper.trial(experiment_.events);
  }

  Trial steps_alone(double h, long parts) const {
    const TimeSpan& time = *experiment_.time;
    State state = start_.point;
    MatrixXd x(state.x.size(), time.steps + 1);
    Index reached = 0;  // columns
    try {
      const PreparedMethod method =
          experiment_.method->prepare({.system = experiment_.model.system,
                                       .ladder = start_,
                                       .initial = start_.point,
                                       .step = h,
                                       .backend = backend_,
                                       .vocabulary = &experiment_.model.vocabulary});
      const auto stepper = method.integrator->stepper();
      state = method.initial;
      x.col(reached++) = state.x;
      stepper->prepare(state, h);
      for (long k = 0; k < time.steps; ++k) {
        for (long i = 1; i <= parts; ++i)
          stepper->step(state, h, time.time(k) + static_cast<double>(i) * h);
        if (stop_ && *stop_) throw std::runtime_error("interrupted");
        if (!state.x.allFinite()) break;
        x.col(reached++) = state.x;
      }
    } catch (const SolveError&) {
    } catch (const std::domain_error&) {
    }
    return {.x = x.leftCols(reached), .last_time = state.t};
  }

  const Experiment& experiment_;
  Backend backend_;
  const std::atomic<bool>* stop_;
  bool jumps_;
  ConstraintLadder start_;  // of steps alone: a run finds its own
};

// The times from an occurrence of an event in one trial to the same one in the other, or to the end where that has none:
// one has jumped then, and the other has not. Likewise those between the ends of trials that failed.
std::vector<std::pair<double, double>> times_between_jumps(const TimeSpan& time, const Trial& a,
                                                           const Trial& b) {
  std::vector<std::pair<double, double>> result;
  for (const auto& [name, of_a] : a.jumps) {
    const std::vector<double>& of_b = b.jumps.at(name);
    for (std::size_t i = 0; i < std::max(of_a.size(), of_b.size()); ++i)
      result.push_back(std::minmax(i < of_a.size() ? of_a[i] : time.end(),
                                   i < of_b.size() ? of_b[i] : time.end()));
  }
  const std::pair<double, double> whole{time.end(), time.end()};
  const auto [a_from, a_to] = a.failed_in.value_or(whole);
  const auto [b_from, b_to] = b.failed_in.value_or(whole);
  if (a_to < b_from) result.emplace_back(a_to, b_from);
  if (b_to < a_from) result.emplace_back(b_to, a_from);
  return result;
}

// States of two trials at the same times, as columns: those at which both have jumped as often, and where both stopped.
std::pair<MatrixXd, MatrixXd> comparable(const TimeSpan& time, const Trial& a, const Trial& b,
                                         const std::vector<std::pair<double, double>>& between) {
  constexpr double beside = 1e-9;
  const auto is_between = [&](Index k) {
    const double t = time.time(k), near = beside * std::fabs(time.step);
    return std::ranges::any_of(between, [&](const auto& times) {
      return t >= times.first - near && t <= times.second + near;
    });
  };
  std::vector<Index> columns;
  for (Index k = 0; k < std::min(a.x.cols(), b.x.cols()); ++k)
    if (!is_between(k)) columns.push_back(k);
  std::pair<MatrixXd, MatrixXd> result{a.x(Eigen::all, columns), b.x(Eigen::all, columns)};
  if (a.stopped_at.size() == 0 || b.stopped_at.size() == 0) return result;
  for (auto& [states, end] : {std::pair<MatrixXd&, const VectorXd&>{result.first, a.stopped_at},
                              {result.second, b.stopped_at}}) {
    states.conservativeResize(Eigen::NoChange, states.cols() + 1);
    states.rightCols(1) = end;
  }
  return result;
}

// The greatest of coordinates where they can be compared, next to their ways, and the part of the time in which they
// cannot.
double difference(const TimeSpan& time, const Trial& coarse, const Trial& fine) {
  const auto has_no_way = [](const Trial& trial) {
    return trial.x.cols() < 2 && trial.stopped_at.size() == 0;
  };
  if (has_no_way(coarse) || has_no_way(fine)) return kNoEstimate;
  double greatest = 0.0;
  const auto between = times_between_jumps(time, coarse, fine);
  for (const auto& [from, to] : between) greatest += (to - from) / (time.end() - time.start);
  const auto [of_coarse, of_fine] = comparable(time, coarse, fine, between);
  for (Index i = 0; i < of_fine.rows() && of_fine.cols() > 0; ++i) {
    const auto row = of_fine.row(i);
    const double way = row.maxCoeff() - row.minCoeff();
    if (way <= kLeastWayCompared * row.cwiseAbs().maxCoeff()) continue;
    greatest = std::max(greatest, (of_coarse.row(i) - row).cwiseAbs().maxCoeff() / way);
  }
  return greatest;
}

// What there is to say of a step beside itself.
std::string remark_on(const ChosenStep& chosen, double tolerance) {
  const std::string step = number_text(chosen.step, 3);
  if (!std::isfinite(chosen.estimate) && !chosen.ended_at)
    return "is " + number_text(tolerance) +
           ", but no step is tried in a run of more than a million rows: it has that of its "
           "rows, " +
           step;
  if (!std::isfinite(chosen.estimate))
    return "is " + number_text(tolerance) +
           ", but no step that was tried leads to a second row: the run has the least, " + step;
  std::string text;
  if (chosen.ended_at)
    text = "is " + number_text(tolerance) +
           ", but no step that was tried leads to the end of the run: with the half of " + step +
           " it ends at t = " + number_text(*chosen.ended_at, 4);
  if (chosen.estimate <= tolerance) return text;
  if (!text.empty())
    return text + ", and coordinates differ by " + number_text(chosen.estimate, 2) +
           " of their ways up to there";
  return "is " + number_text(tolerance) +
         ", which no step reaches that was tried: with the half of " + number_text(chosen.step) +
         " coordinates differ by " + number_text(chosen.estimate, 2) + " of their ways";
}

}  // namespace

ChosenStep chosen_step(const Experiment& experiment, Backend backend,
                       const std::atomic<bool>* stop) {
  const TimeSpan& time = *experiment.time;
  const double tolerance = *time.tolerance;
  if (static_cast<double>(time.steps) > kMostStepsTried) return {time.step, kNoEstimate};
  const Trials trials(experiment, backend, stop);
  long parts = 1;
  Trial coarse = trials.run(parts);
  ChosenStep best{time.step, kNoEstimate};
  int in_vain = 0;  // halvings that left the estimate as it was
  double before = kNoEstimate;
  while (in_vain < kMostInVain &&
         static_cast<double>(parts) * static_cast<double>(time.steps) <= kMostStepsTried) {
    Trial fine = trials.run(2 * parts);
    const double estimate = difference(time, coarse, fine);
    if (estimate < best.estimate)
      best = {time.step / static_cast<double>(parts), estimate,
              fine.failed_in ? std::optional(fine.failed_in->first) : std::nullopt};
    if (estimate <= tolerance) return best;
    if (std::isfinite(estimate) && estimate > kFalls * before) ++in_vain;
    before = estimate;
    // An error of order 2 has a quarter with each half.
    const double halves =
        std::isfinite(estimate) ? std::floor(0.5 * std::log2(estimate / tolerance)) : 1.0;
    const int further = static_cast<int>(std::clamp(halves, 1.0, 4.0));
    parts *= 1L << further;
    coarse = further == 1 ? std::move(fine) : trials.run(parts);
  }
  // What stands in the way of the first step, the run with the least of them says.
  if (!std::isfinite(best.estimate))
    best = {time.step / static_cast<double>(parts), kNoEstimate, time.start};
  return best;
}

std::shared_ptr<const Experiment> with_chosen_step(const Experiment& experiment,
                                                   const ChosenStep& chosen) {
  Json document = experiment.document;
  document["time"]["step"] = chosen.step;
  auto result = std::make_shared<Experiment>(read_experiment_document(document));
  result->remarks = experiment.remarks;
  if (const std::string remark = remark_on(chosen, *experiment.time->tolerance); !remark.empty())
    result->remarks.push_back({"/time/tolerance", remark});
  return result;
}

}  // namespace courant
