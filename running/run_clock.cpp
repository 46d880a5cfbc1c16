#include "courant/running/run_clock.hpp"

#include <algorithm>
#include <cmath>

namespace courant {
namespace {

// A step that ends so near to the end of a run, next to its length in t, ends there: it is what time
// collects in round-off.
constexpr double kAtEnd = 1e-10;

constexpr double kMostSteps = 1e15;

}  // namespace

double RunClock::t(const State& state, long k) const {
  if (is_last_) return time_->until;
  return time_ && !is_transformed() ? time_->time(k) : state.t;
}

long RunClock::steps(long k, double t) const {
  if (!time_) return 0;
  if (!is_transformed()) return time_->steps;
  if (is_last_ || time_->steps == 0) return k;
  const double share = (t - time_->start) / (time_->until - time_->start);
  const double all = std::min(kMostSteps, static_cast<double>(k) / share);
  return std::max(k + 1, std::isfinite(all) ? std::lround(all) : 0L);
}

void RunClock::end_step(Stepper& stepper, State& state, long k) {
  const double near = kAtEnd * (state.t - stepper.last().before.t);
  tau_ = time_->time(k);
  is_last_ = state.t >= time_->until - near;
  if (state.t <= time_->until + near) return;
  const double h = stepper.share_at(time_->until) * time_->step;
  state = stepper.last().before;
  stepper.step(state, h);
  tau_ = time_->time(k - 1) + h;
}

}  // namespace courant
