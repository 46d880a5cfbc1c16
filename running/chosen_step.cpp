#include "courant/running/chosen_step.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>
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
// Ways of quantities below this part of their greatest value are round-off.
constexpr double kLeastWayCompared = 1e-9;
constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

// The quantities of a trial that are compared, each set next to the greatest way of one of them: t, which tells where
// an event ended the run, and what tells of the coordinates, the first so many sets; behind them what is observed.
struct Compared {
  std::vector<std::vector<std::string>> kinds = {{"t"}};
  std::size_t of_states = 1;

  void add(const Model& model, const std::vector<std::string>& names) {
    std::map<std::string, std::vector<std::string>> found;
    for (const std::string& name : names) {
      const auto kind = model.kinds.find(name);
      found[kind == model.kinds.end() ? name : kind->second].push_back(name);
    }
    for (auto& [kind, alike] : found) kinds.push_back(std::move(alike));
  }
};

// Observables that are a quantity of the network, such as a potential: of formulas of several nothing says what they
// are small next to.
std::vector<std::string> observed_quantities(const Experiment& experiment) {
  std::vector<std::string> names;
  for (const auto& [name, formula, at_stage, uses_energies] : experiment.observe)
    if (!at_stage && experiment.model.kinds.contains(formula.text)) names.push_back(formula.text);
  return names;
}

Compared compared(const Experiment& experiment) {
  const Model& model = experiment.model;
  Compared result;
  result.add(model, model.efforts.empty() ? model.system->names().coordinates : model.efforts);
  result.of_states = result.kinds.size();
  result.add(model, observed_quantities(experiment));
  return result;
}

// The experiment of the trials: what is compared is observed, and nothing else that may end a run.
Experiment to_try(const Experiment& experiment) {
  Experiment trial = experiment;
  std::vector<std::string> names = observed_quantities(experiment);
  names.insert(names.end(), experiment.model.efforts.begin(), experiment.model.efforts.end());
  trial.observe.clear();
  for (const std::string& name : std::set<std::string>(names.begin(), names.end()))
    trial.observe.push_back({.name = name, .formula = {name, "/observe"}});
  trial.writes_energies = trial.writes_balance = false;
  trial.defects.clear();
  trial.sensitivities.reset();
  trial.symmetries.clear();
  trial.expect = {};
  trial.examine = 0;
  // Boundary values are sought after a step is chosen, of one smooth map.
  if (trial.boundary) trial.events.clear();
  trial.boundary.reset();
  trial.output = {};
  trial.time->is_chosen = true;
  return trial;
}

// What a trial leaves: t and what is compared at the ends of the longest steps, a column for each of these, and behind
// them where the run ended by itself or by an event; what it has not is missing.
struct Trial {
  MatrixXd rows = {};
  double last_time = 0.0;
  bool has_failed = false;
};

// Keeps of a run what a trial leaves, of every so many steps.
class TrialKeeper final : public RunKeeper {
 public:
  TrialKeeper(const Compared& compared, const TimeSpan& longest, long parts)
      : compared_(compared), longest_(longest), parts_(parts) {
    trial_.last_time = longest.start;
  }

  void open(const RunOpening& opening) override {
    const std::vector<std::string>& names = opening.event_columns;
    for (const std::vector<std::string>& kind : compared_.kinds)
      for (const std::string& name : kind)
        if (name != "t") places_.push_back(std::ranges::find(names, name) - names.begin());
    trial_.rows = MatrixXd::Constant(1 + std::ssize(places_), longest_.steps + 2, kMissing);
  }
  void append(double, const std::optional<double>&, const Eigen::Ref<const VectorXd>&) override {}
  void append_event(const std::string&, double, const Eigen::Ref<const VectorXd>&) override {}
  void see(const RunMoment& moment) override {
    constexpr double round_off = 1e-9;
    trial_.last_time = moment.t;
    const Index row = moment.k / parts_;
    const double beside = std::fabs(moment.t - longest_.time(row));
    // An event may have stopped the run within the step.
    const bool is_whole = moment.k % parts_ == 0 && beside <= round_off * std::fabs(longest_.step);
    if (is_whole) trial_.rows.col(row) << moment.t, moment.row(places_);
    if (moment.k == moment.steps) trial_.rows.rightCols(1) << moment.t, moment.row(places_);
  }
  void close() override {}
  void tell(const RunSummary&) override {}

  Trial trial(const RunOutcome& outcome) && {
    trial_.has_failed = outcome.status == RunStatus::failed;
    return std::move(trial_);
  }

 private:
  const Compared& compared_;
  const TimeSpan& longest_;
  long parts_;
  std::vector<Index> places_;
  Trial trial_;
};

// Of the rows of two trials: the least ε for which no more than the part ε of the rows differs by more than ε, the metric
// of Ky Fan; and the mean, which falls as differences fall. Where a quantity jumps rows beside the jump differ by as much
// as it, however short steps are, but fewer of them.
struct RowDifference {
  double estimate = kNoEstimate, mean = kNoEstimate;

  static RowDifference of(std::vector<double> rows) {
    std::ranges::sort(rows, std::greater<>());
    const double count = static_cast<double>(rows.size());
    RowDifference found{1.0, 0.0};
    for (std::size_t k = 0; k < rows.size(); ++k) {
      found.estimate = std::min(found.estimate, std::max(rows[k], static_cast<double>(k) / count));
      found.mean += std::min(rows[k], 1.0) / count;
    }
    return found;
  }
};

// Runs with steps that are tried.
class Trials {
 public:
  Trials(const Experiment& experiment, Backend backend, const std::atomic<bool>* stop)
      : experiment_(to_try(experiment)),
        compared_(compared(experiment)),
        start_(consistent_start(experiment)) {
    options_.backend = backend;
    options_.stop = stop;
    options_.explains_start = false;
  }

  // The steps of a longest one in so many parts.
  Trial run(long parts) const { return carried_out(experiment_, parts); }

  // Where corners end steps those of half the size may be made of the same pieces: there each piece has two halves.
  bool has_corners() const {
    const auto& division = experiment_.time->division;
    return division && !division->corners.empty();
  }
  Trial run_in_halves(long parts) const {
    if (!has_corners()) return run(2 * parts);
    Experiment halved = experiment_;
    halved.method->prepare = [prepare = halved.method->prepare](const MethodSetting& at) {
      PreparedMethod method = prepare(at);
      method.integrator =
          dynamic_cast<const SubsteppingIntegrator&>(*method.integrator).in_parts(2);
      return method;
    };
    return carried_out(halved, parts);
  }

  // Of the coordinates, and of what is observed.
  struct Differences {
    RowDifference states, observed;
  };
  Differences differences(const Trial& coarse, const Trial& fine) const;

 private:
  Trial carried_out(Experiment experiment, long parts) const {
    experiment.time->step /= static_cast<double>(parts);
    experiment.time->steps *= parts;
    TrialKeeper keeper(compared_, *experiment_.time, parts);
    const RunOutcome outcome = carry_out(experiment, keeper, options_, start_);
    if (outcome.status == RunStatus::interrupted) throw std::runtime_error("interrupted");
    return std::move(keeper).trial(outcome);
  }

  Experiment experiment_;
  Compared compared_;
  ConsistentStart start_;
  RunOptions options_;
};

// A row that only one trial has differs.
Trials::Differences Trials::differences(const Trial& coarse, const Trial& fine) const {
  const auto is_there = [](const Trial& trial, Index k) { return trial.rows.col(k).allFinite(); };
  std::vector<Index> common;
  std::vector<double> alone;
  for (Index k = 0; k < std::min(coarse.rows.cols(), fine.rows.cols()); ++k) {
    if (is_there(coarse, k) && is_there(fine, k))
      common.push_back(k);
    else if (is_there(coarse, k) || is_there(fine, k))
      alone.push_back(kNoEstimate);
  }
  if (common.size() < 2) return {};
  Index first = 0;
  const auto difference = [&](std::size_t from, std::size_t to) {
    VectorXd greatest = VectorXd::Zero(std::ssize(common));
    for (std::size_t kind = from; kind < to; ++kind) {
      const auto places = Eigen::seqN(first, std::ssize(compared_.kinds[kind]));
      first += places.size();
      const MatrixXd rows = fine.rows(places, common);
      const double way = (rows.rowwise().maxCoeff() - rows.rowwise().minCoeff()).maxCoeff();
      if (way <= kLeastWayCompared * rows.cwiseAbs().maxCoeff()) continue;
      const MatrixXd apart = (coarse.rows(places, common) - rows).cwiseAbs();
      greatest = greatest.cwiseMax(apart.colwise().maxCoeff().transpose() / way);
    }
    std::vector<double> all = alone;
    all.insert(all.end(), greatest.begin(), greatest.end());
    return RowDifference::of(std::move(all));
  };
  const RowDifference of_states = difference(0, compared_.of_states);
  return {of_states, difference(compared_.of_states, compared_.kinds.size())};
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
  int in_vain = 0;                                   // halvings that left the estimate as it was
  double before = kNoEstimate, least = kNoEstimate;  // means
  while (in_vain < kMostInVain &&
         static_cast<double>(parts) * static_cast<double>(time.steps) <= kMostStepsTried) {
    Trial fine = trials.run_in_halves(parts);
    const auto [states, observed] = trials.differences(coarse, fine);
    const bool had_states = best.estimate <= tolerance, has_states = states.estimate <= tolerance;
    // What is observed may be round-off where the coordinates are not: the node between two diodes that block.
    if (had_states ? has_states && observed.mean < kFalls * least
                   : states.estimate < best.estimate) {
      best = {time.step / static_cast<double>(parts), states.estimate, observed.estimate,
              fine.has_failed ? std::optional(fine.last_time) : std::nullopt};
      least = observed.mean;
    }
    if (has_states && observed.estimate <= tolerance) return best;
    if (!had_states && has_states) before = kNoEstimate;
    const auto [estimate, mean] = has_states ? observed : states;
    if (std::isfinite(mean) && mean > kFalls * before) ++in_vain;
    before = mean;
    // An error of order 2 has a quarter with each half.
    const double halves =
        std::isfinite(estimate) ? std::floor(0.5 * std::log2(estimate / tolerance)) : 1.0;
    const int further = static_cast<int>(std::clamp(halves, 1.0, 4.0));
    parts *= 1L << further;
    coarse = further == 1 && !trials.has_corners() ? std::move(fine) : trials.run(parts);
  }
  // What stands in the way of the first step, the run with the least of them says.
  if (!std::isfinite(best.estimate))
    best = {.step = time.step / static_cast<double>(parts),
            .estimate = kNoEstimate,
            .ended_at = time.start};
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
