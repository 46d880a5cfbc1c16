#include "courant/running/step_watch.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "courant/core/words/message.hpp"
#include "courant/integrators/step/solve_error.hpp"

namespace courant {
namespace {

constexpr double kSuddenTurn = 0.5;  // of the longer of two steps
constexpr double kFurtherTurn = 2.0;
// A third of a step of order 1 is off by a third as much; errors that do not fall at all, by as much.
constexpr double kFallsByThirds = 0.6;
constexpr double kHalfOfWay = 0.5;
// Next to the largest coordinate: shorter steps are round-off.
constexpr double kLeastWayOfStep = 1e-6;

double size_of_kind(const VectorXd& x, const std::pair<Index, Index>& kind) {
  return x.segment(kind.first, kind.second).lpNorm<Eigen::Infinity>();
}

}  // namespace

StepWatch::StepWatch(std::shared_ptr<const Integrator> integrator,
                     std::vector<std::pair<Index, Index>> kinds)
    : integrator_(std::move(integrator)), kinds_(std::move(kinds)) {
  std::erase_if(kinds_, [](const auto& kind) { return kind.second == 0; });
  forget();
}

void StepWatch::forget() {
  last_.resize(0);
  looked_at_ = VectorXd::Zero(std::ssize(kinds_));
}

std::optional<RunEnd> StepWatch::watch(const RunMoment& moment) {
  if (moment.k == 0) return std::nullopt;
  const VectorXd way = moment.step.after.x - moment.step.before.x;
  bool is_sudden = false;
  if (last_.size() == way.size())
    for (std::size_t i = 0; i < kinds_.size(); ++i) {
      const double bend = size_of_kind(way - last_, kinds_[i]);
      const double longer = std::max(size_of_kind(way, kinds_[i]), size_of_kind(last_, kinds_[i]));
      double& looked_at = looked_at_[static_cast<Index>(i)];
      if (!(bend > kSuddenTurn * longer) || !(bend > kFurtherTurn * looked_at)) continue;
      looked_at = bend;
      is_sudden = true;
    }
  last_ = way;
  return is_sudden ? look(moment) : std::nullopt;
}

std::optional<RunEnd> StepWatch::look(const RunMoment& moment) const {
  const Step& step = moment.step;
  std::array<VectorXd, 3> ends;
  try {
    int parts = 1;
    for (VectorXd& end : ends) {
      end = integrator_->advance(step.before, step.h / parts, parts).x;
      parts *= 3;
    }
  } catch (const SolveError& error) {
    // A step over what its parts do not go through may end on another branch of the solutions. With what an event set
    // on the way the parts are other ways.
    if (error.reason() != SolveError::Reason::singular || !step.parts.empty()) return std::nullopt;
    return RunEnd{RunStatus::failed,
                  "The step to t = " + number_text(moment.t) +
                      " turns at once, and the same way cannot be gone in shorter steps, as at an "
                      "impasse or where solutions branch; its end is no state of the solution. " +
                      error.what()};
  } catch (const std::runtime_error&) {  // another fault says nothing
    return std::nullopt;
  } catch (const std::domain_error&) {
    return std::nullopt;
  }
  for (const auto& kind : kinds_) {
    const double way = size_of_kind(ends[0] - step.before.x, kind);
    const double first = size_of_kind(ends[0] - ends[1], kind),
                 second = size_of_kind(ends[1] - ends[2], kind);
    const bool is_resolved = first + second <= kHalfOfWay * way ||
                             (first + second <= way && second <= kFallsByThirds * first);
    if (is_resolved || way <= kLeastWayOfStep * size_of_kind(step.before.x, kind)) continue;
    return RunEnd{
        RunStatus::failed,
        "The step to t = " + number_text(moment.t) + ", by " + number_text(way, 3) +
            ", and the same way in three and in nine parts end apart, by " + number_text(first, 3) +
            " and " + number_text(second, 3) +
            ". The steps do not resolve the solution there, as at a collision, a pole or an "
            "impasse, or where something decays faster than a step, and their end is no state of "
            "it."};
  }
  return std::nullopt;
}

}  // namespace courant
