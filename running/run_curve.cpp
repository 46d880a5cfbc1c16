#include "courant/running/run_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "courant/core/words/message.hpp"

namespace courant {

RunCurve::RunCurve(Experiment experiment, ConstraintLadder ladder,
                   std::shared_ptr<const Integrator> integrator, std::vector<Piece> pieces)
    : experiment_(std::move(experiment)),
      ladder_(std::move(ladder)),
      integrator_(std::move(integrator)),
      pieces_(std::move(pieces)),
      observer_(experiment_, ladder_, Backend::interpreter),
      stepper_(integrator_->stepper()) {}

State RunCurve::at(double t) {
  const double direction = last() < first() ? -1.0 : 1.0;
  const auto after = std::ranges::upper_bound(
      pieces_, direction * t, {}, [&](const Piece& piece) { return direction * piece.state.t; });
  if (after == pieces_.begin() || direction * t > direction * last())
    throw std::invalid_argument("RunCurve: t is " + exact_text(t) + "; expected a time from " +
                                exact_text(first()) + " to " + exact_text(last()) + ".");
  const Piece& before = *std::prev(after);
  // Steps of the size of round-off in t have no solution that could be told from the state.
  const double round_off =
      4 * std::numeric_limits<double>::epsilon() * std::max(std::fabs(t), std::fabs(before.h));
  if (after == pieces_.end() || std::fabs(t - before.state.t) <= round_off) return before.state;
  State state = before.state;
  if (before.is_in_t) {
    stepper_->step(state, t - state.t, t);
    return state;
  }
  stepper_->step(state, before.h);
  return stepper_->between(stepper_->share_at(t));
}

const VectorXd& RunCurve::operator()(double t) { return observer_.row(at(t)); }

}  // namespace courant
