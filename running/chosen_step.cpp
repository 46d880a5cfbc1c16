#include "courant/running/chosen_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "courant/core/words/message.hpp"
#include "courant/running/consistent_start.hpp"

namespace courant {
namespace {

constexpr double kMostStepsTried = 1e6;
// An estimate that is more than this part of that with a longer step has not fallen; so many of them are tried.
constexpr double kFalls = 0.8;
constexpr int kMostInVain = 2;
constexpr double kNoEstimate = std::numeric_limits<double>::infinity();
// Ways of coordinates below this part of their greatest value are round-off.
constexpr double kLeastWayCompared = 1e-9;

// The coordinates at the ends of the longest steps, as columns; nothing where a step cannot be made.
class Trials {
 public:
  Trials(const Experiment& experiment, Backend backend, const std::atomic<bool>* stop)
      : experiment_(experiment),
        backend_(backend),
        stop_(stop),
        start_(consistent_start(experiment)) {}

  std::optional<MatrixXd> run(long parts) const {
    const TimeSpan& time = *experiment_.time;
    const double h = time.step / static_cast<double>(parts);
    try {
      const PreparedMethod method =
          experiment_.method->prepare({.system = experiment_.model.system,
                                       .ladder = start_,
                                       .initial = start_.point,
                                       .step = h,
                                       .backend = backend_,
                                       .vocabulary = &experiment_.model.vocabulary});
      const auto stepper = method.integrator->stepper();
      State state = method.initial;
      MatrixXd x(state.x.size(), time.steps + 1);
      x.col(0) = state.x;
      stepper->prepare(state, h);
      for (long k = 0; k < time.steps; ++k) {
        for (long i = 1; i <= parts; ++i)
          stepper->step(state, h, time.time(k) + static_cast<double>(i) * h);
        if (!state.x.allFinite()) return std::nullopt;
        if (stop_ && *stop_) throw std::runtime_error("interrupted");
        x.col(k + 1) = state.x;
      }
      return x;
    } catch (const SolveError&) {
    } catch (const std::domain_error&) {
    }
    return std::nullopt;
  }

 private:
  const Experiment& experiment_;
  Backend backend_;
  const std::atomic<bool>* stop_;
  ConstraintLadder start_;
};

double difference(const std::optional<MatrixXd>& coarse, const std::optional<MatrixXd>& fine) {
  if (!coarse || !fine) return kNoEstimate;
  double greatest = 0.0;
  for (Index i = 0; i < fine->rows(); ++i) {
    const auto row = fine->row(i);
    const double way = row.maxCoeff() - row.minCoeff();
    if (way <= kLeastWayCompared * row.cwiseAbs().maxCoeff()) continue;
    greatest = std::max(greatest, (coarse->row(i) - row).cwiseAbs().maxCoeff() / way);
  }
  return greatest;
}

}  // namespace

ChosenStep chosen_step(const Experiment& experiment, Backend backend,
                       const std::atomic<bool>* stop) {
  const TimeSpan& time = *experiment.time;
  const double tolerance = *time.tolerance;
  const Trials trials(experiment, backend, stop);
  long parts = 1;
  std::optional<MatrixXd> coarse = trials.run(parts);
  ChosenStep best{time.step, kNoEstimate};
  int in_vain = 0;  // halvings that left the estimate as it was
  double before = kNoEstimate;
  while (in_vain < kMostInVain &&
         static_cast<double>(parts) * static_cast<double>(time.steps) <= kMostStepsTried) {
    const std::optional<MatrixXd> fine = trials.run(2 * parts);
    const double estimate = difference(coarse, fine);
    if (estimate < best.estimate) best = {time.step / static_cast<double>(parts), estimate};
    if (estimate <= tolerance) return best;
    if (std::isfinite(estimate) && estimate > kFalls * before) ++in_vain;
    before = estimate;
    // An error of order 2 has a quarter with each half.
    const double halves =
        std::isfinite(estimate) ? std::floor(0.5 * std::log2(estimate / tolerance)) : 1.0;
    const int further = static_cast<int>(std::clamp(halves, 1.0, 4.0));
    parts *= 1L << further;
    coarse = further == 1 ? fine : trials.run(parts);
  }
  if (!std::isfinite(best.estimate))
    throw ExperimentError("/time/tolerance",
                          "cannot be reached: with no step that was tried, the least of them " +
                              number_text(time.step / static_cast<double>(parts), 3) +
                              ", the run comes to its end; expected a step");
  return best;
}

std::shared_ptr<const Experiment> with_chosen_step(const Experiment& experiment,
                                                   const ChosenStep& chosen) {
  Json document = experiment.document;
  document["time"]["step"] = chosen.step;
  auto result = std::make_shared<Experiment>(read_experiment_document(document));
  result->remarks = experiment.remarks;
  const double tolerance = *experiment.time->tolerance;
  if (chosen.estimate > tolerance)
    result->remarks.push_back(
        {"/time/tolerance", "is " + number_text(tolerance) +
                                ", which no step reaches that was tried: with the half of " +
                                number_text(chosen.step) + " coordinates differ by " +
                                number_text(chosen.estimate, 2) + " of their ways"});
  return result;
}

}  // namespace courant
