#include "courant/running/run_jumps.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <stdexcept>
#include <utility>

#include "courant/core/words/message.hpp"

namespace courant {
namespace {

constexpr int kMostJumpsTold = 3;
constexpr int kMostResets = 30;  // within a step

}  // namespace

RunJumps::RunJumps(const Experiment& experiment, std::size_t first_reset,
                   ObserverElsewhere& elsewhere, std::vector<std::string>& warnings)
    : experiment_(experiment), elsewhere_(elsewhere), warnings_(warnings) {
  if (std::ranges::any_of(experiment.events, &Event::sets))
    resets_.emplace(experiment, first_reset);
}

std::optional<Step> RunJumps::over_corners(const State& before, long k,
                                           const Integrator& integrator) {
  // A corner is as far from what is evaluated beside it.
  constexpr double beside = 1e-9, near = 1e-3;
  const TimeSpan& time = *experiment_.time;
  const double begin = time.time(k), end = time.time(k + 1), h = time.step;
  State state = before;
  bool jumped = false;
  for (const double corner : SubsteppingIntegrator::corners_within(
           time.division->corners, begin - near * h, (1.0 + 2.0 * near) * h)) {
    if (const double way = corner - state.t - beside * h; way > near * h)
      state = integrator.advance(state, way, 1);
    const std::optional<State> there = beyond(state, corner);
    if (!there) return std::nullopt;
    state = *there;
    jumped = true;
  }
  if (!jumped) return std::nullopt;
  if (const double way = end - state.t; way > near * h) state = integrator.advance(state, way, 1);
  state.t = end;
  return Step{.h = h, .before = before, .after = state, .stage = state};
}

// The consistent state that impulses lead to on the other side of a corner; nothing where there is none.
std::optional<State> RunJumps::beyond(const State& before, double corner) {
  std::optional<Restart> behind = restart(experiment_, before, corner);
  if (!behind) return std::nullopt;
  tell_of_jump("At the corner t = " + number_text(corner) + " there is a jump: ", *behind);
  return std::move(behind->state);
}

void RunJumps::tell_of_jump(const std::string& where, const Restart& behind) {
  if (!behind.moves.empty() && ++jumps_ <= kMostJumpsTold)
    warnings_.push_back(where + behind.moves +
                        (behind.is_impulse ? ", as an impulse makes it." : "."));
}

std::optional<Step> RunJumps::over_resets(const Step& whole, long k, const Integrator& integrator,
                                          EventWatch& events,
                                          const std::function<void(Stepper&)>& prepare) {
  // Less of a step is none, and what comes again after less accumulates.
  constexpr double no_way = 1e-12, no_pause = 1e-9;
  const double h = experiment_.time->step, end = experiment_.time->time(k);
  std::unique_ptr<Stepper> way;
  Step part = whole;
  State after;
  std::vector<Step> ways;
  std::map<std::size_t, double> last;  // of each event
  bool is_over = false;
  for (std::optional<EventWatch::Reset> reset; !is_over && (reset = reset_in(part, k, events));) {
    const double t = reset->step.after.t;
    const auto before = last.find(reset->event);
    if (std::ssize(ways) >= kMostResets ||
        (before != last.end() && std::abs(t - before->second) < no_pause * std::abs(h)))
      throw std::domain_error("The times of the event " + experiment_.events[reset->event].name +
                              " accumulate at t = " + number_text(t) + ": it has set something " +
                              std::to_string(std::ssize(ways)) + " times within a step.");
    last[reset->event] = t;
    ways.push_back(reset->step);
    way = integrator.stepper();
    prepare(*way);
    after = behind(*reset, events, *way);
    is_over = std::abs(end - t) < no_way * std::abs(h);
    if (is_over) continue;
    way->step(after, end - t, end);
    part = way->last();
  }
  if (ways.empty()) return std::nullopt;
  if (!is_over) ways.push_back(part);
  after.t = end;
  return Step{.h = h,
              .before = whole.before,
              .after = after,
              .stage = ways.back().stage,
              .effort = ways.back().effort,
              .parts = std::move(ways)};
}

// The first reset of a part of a step, whose other events are told.
std::optional<EventWatch::Reset> RunJumps::reset_in(const Step& part, long k, EventWatch& events) {
  if (part.h == 0.0) return std::nullopt;
  const VectorXd row = elsewhere_.row_within(part);
  events.watch({.k = k, .steps = k, .t = part.after.t, .row = row, .step = part});
  return events.take_reset();
}

// The state behind a reset, and behind those that its jump leads to.
State RunJumps::behind(EventWatch::Reset reset, EventWatch& events, Stepper& way) {
  for (int count = 0; count < kMostResets; ++count) {
    const State& at = reset.step.after;
    const std::string name = experiment_.events[reset.event].name;
    const std::optional<Restart> there = (*resets_)(reset.event, at, reset.row);
    if (!there)
      throw std::domain_error("Nothing goes on from what the event " + name + " sets at t = " +
                              number_text(at.t) + ": there is no consistent state near it.");
    tell_of_jump("At t = " + number_text(at.t) + " the event " + name + " moves also ", *there);
    std::optional<EventWatch::Reset> next =
        events.go_on_behind(reset, elsewhere_.row(there->state), way);
    if (!next) return there->state;
    next->step.after = there->state;
    reset = *std::move(next);
  }
  throw std::domain_error("Events set something over and over at t = " +
                          number_text(reset.step.after.t) + ": each leads to the next.");
}

}  // namespace courant
