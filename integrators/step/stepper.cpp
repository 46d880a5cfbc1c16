#include "courant/integrators/step/stepper.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "courant/core/solve/bracketed_root.hpp"
#include "courant/core/words/message.hpp"

namespace courant {
namespace {

// A stage of a composition begins at most so many lengths of its last step away from where that
// ended: the coefficients of compositions lie between 0.1 and 2. A state farther off belongs to
// another curve.
constexpr double kNearSteps = 16.0;

// The share of a step that goes with a time is found to this length of its bracket, which is round-off.
constexpr double kShortestBracket = 4e-16;
constexpr unsigned kMostEvaluations = 100;

void check_size(const std::string& method, const char* part, Index size, Index expected,
                bool may_be_empty) {
  if (size == expected || (may_be_empty && size == 0)) return;
  throw std::invalid_argument(method + ": " + part + " has " + std::to_string(size) +
                              " entries, expected " + std::to_string(expected) +
                              (may_be_empty ? " or none." : "."));
}

}  // namespace

Stepper::Stepper(std::string method, std::shared_ptr<const ImplicitSystem> system)
    : method_(std::move(method)), system_(std::move(system)) {}

void Stepper::refuse(double h) const {
  throw std::invalid_argument(method_ + ": h is " + number_text(h) +
                              "; expected a finite number other than zero.");
}

void Stepper::check(const State& state) const {
  check_size(method_, "x", state.x.size(), manifold().ambient_dimension(), false);
  check_size(method_, "v", state.v.size(), manifold().tangent_dimension(), true);
  check_size(method_, "z", state.z.size(), system_->auxiliary_size(), true);
}

// `from` may have ended there.
void Stepper::take_up(State& state, double h, const Stepper* from) {
  if (from != nullptr && from->is_prepared_ && state == from->last_->after && do_take_over(*from)) {
    is_prepared_ = true;
    return;
  }
  // A step keeps the distance from the manifold that it begins with, or blows it up.
  if (!has_stepped_ && do_keeps_to_manifold()) {
    const double defect = manifold().point_defect(state.x);
    const double bound = 1e-6 * (1.0 + state.x.squaredNorm());
    if (!(defect <= bound))
      throw std::domain_error(method_ + ": x is not on " + manifold().name() +
                              ", whose equations it violates by " + number_text(defect) +
                              "; expected at most " + number_text(bound) + ". Project it first.");
  }
  if (state.v.size() == 0) state.v = VectorXd::Zero(manifold().tangent_dimension());
  if (state.z.size() == 0) state.z = VectorXd::Zero(system_->auxiliary_size());
  is_prepared_ = false;
  do_prepare(state, h);
  is_prepared_ = true;
}

// Whether the state may lie on the curve of the last steps.
bool Stepper::is_near_last(const State& state) const {
  const auto largest = [](const VectorXd& x) {
    return x.size() == 0 ? 0.0 : x.lpNorm<Eigen::Infinity>();
  };
  return std::fabs(state.t - last_->after.t) <=
             kNearSteps * std::fabs(last_->after.t - last_->before.t) &&
         largest(state.x - last_->after.x) <=
             kNearSteps * largest(last_->after.x - last_->before.x);
}

void Stepper::prepare(State& state, double h) {
  if (!std::isfinite(h) || h == 0.0) refuse(h);
  check(state);
  if (is_prepared_ && state == last_->after) return;
  forget();
  State prepared = state;
  take_up(prepared, h);
  last_->after = state = prepared;
}

void Stepper::step(State& state, double h, double end) { make_step(state, h, end, nullptr); }

void Stepper::step_from(const Stepper& other, State& state, double h, double end) {
  make_step(state, h, end, &other);
}

void Stepper::make_step(State& state, double h, double end, const Stepper* from) {
  if (!std::isfinite(h) || h == 0.0) refuse(h);
  const bool goes_on = is_prepared_ && state == last_->after;
  if (!goes_on) {
    check(state);
    if (has_stepped_ && !is_near_last(state)) forget();
    trial_->before = state;
    take_up(trial_->before, h, from);
  }
  make_prepared_step(goes_on, h, end);
  state.take(last_->after);
}

void Stepper::go_on(double h, double end) {
  if (!std::isfinite(h) || h == 0.0) refuse(h);
  if (!is_prepared_)
    throw std::logic_error(method_ +
                           ": go_on: no state has been prepared; expected a step before.");
  make_prepared_step(true, h, end);
}

// From last_->after if it goes on, else from trial_->before.
void Stepper::make_prepared_step(bool goes_on, double h, double end) {
  if (has_stepped_ && h != last_->h) do_change_step();
  State& before = goes_on ? last_->after : trial_->before;
  State& after = trial_->after;
  const long failures = statistics_.failures;
  after.t = end;
  try {
    do_step(before, h, after);
    if (!is_finite(after))
      throw SolveError(SolveError::Reason::left_domain, method_, before.t, h,
                       "leads to a state that is not finite.");
  } catch (...) {
    do_discard();
    // What was kept of the states before has made place for this one.
    if (!goes_on) forget();
    throw;
  }
  do_keep(before, after);
  ++statistics_.steps;
  if (statistics_.failures > failures) ++statistics_.second_attempts;
  if (goes_on) trial_->before.swap(before);
  trial_->h = h;
  std::swap(last_, trial_);
  has_stepped_ = true;
  has_stage_ = false;
}

const Step& Stepper::last() {
  if (has_stepped_ && !has_stage_) {
    do_stage(*last_);
    has_stage_ = true;
  }
  return *last_;
}

State Stepper::between(double s) { return part(s).after; }

Step Stepper::part(double s) {
  if (!has_stepped_) throw std::logic_error(method_ + ": between: no step has been made.");
  if (!(s >= 0.0 && s <= 1.0))
    throw std::invalid_argument(method_ + ": between: s is " + number_text(s) +
                                "; expected a number from 0 to 1.");
  if (s == 0.0) return {.before = last_->before, .after = last_->before, .stage = last_->before};
  if (s == 1.0) return last();
  if (!between_) between_ = do_fresh();
  between_->forget();
  between_->tells_parts_ = tells_parts_;
  State state = last_->before;
  between_->step(state, s * last_->h);
  return between_->last();
}

double Stepper::share_at(double t) {
  const Step& step = last();
  const double before = step.before.t, after = step.after.t;
  if (!has_stepped_ || !((t - before) * (after - t) >= 0.0))
    throw std::invalid_argument(method_ + ": share_at: t is " + number_text(t) +
                                "; expected a time of the last step, from " + number_text(before) +
                                " to " + number_text(after) + ".");
  const double linear = (t - before) / (after - before);
  if (step.rate == 1.0 || t == before || t == after) return linear;
  const auto [low, high] =
      bracketed_root([&](double s) { return between(s).t - t; }, {0.0, 1.0}, before - t, after - t,
                     kShortestBracket, kMostEvaluations);
  return std::fabs(between(low).t - t) <= std::fabs(between(high).t - t) ? low : high;
}

void Stepper::forget() {
  has_stepped_ = is_prepared_ = false;
  do_forget();
}

}  // namespace courant
