#include "courant/running/restart.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "courant/core/words/message.hpp"
#include "courant/running/consistent_start.hpp"

namespace courant {
namespace {

constexpr std::size_t kMostMoves = 4;  // that are told

InitialValues nothing_given(const Experiment& experiment) {
  const InitialValues& initial = experiment.initial;
  return {.x = PartialVector(initial.x.values.size()),
          .velocity = PartialVector(initial.velocity.values.size()),
          .z = PartialVector(initial.z.values.size()),
          .weight = initial.weight,
          .nominal = initial.nominal};
}

std::string told(const std::vector<Movement>& moves) {
  std::string text;
  for (std::size_t i = 0; i < std::min(kMostMoves, moves.size()); ++i)
    text += (text.empty() ? "" : ", ") + moves[i].name + " from " + number_text(moves[i].from) +
            " to " + number_text(moves[i].to);
  if (moves.size() > kMostMoves)
    text += " and " + std::to_string(moves.size() - kMostMoves) + " more";
  return text;
}

std::optional<Restart> restart_from(const Experiment& experiment, InitialValues initial, double t) {
  Experiment there = experiment;
  there.time->start = t;
  there.initial = std::move(initial);
  const ConsistentStart ladder = consistent_start(there);
  if (ladder.verdict == Verdict::inconsistent || ladder.verdict == Verdict::not_reached)
    return std::nullopt;
  State state = ladder.point;
  state.t = t;
  return Restart{std::move(state), told(ladder.moves), ladder.is_impulse};
}

}  // namespace

std::optional<Restart> restart(const Experiment& experiment, const State& before, double t) {
  InitialValues initial = nothing_given(experiment);
  initial.x.values = before.x;
  initial.x.given.setConstant(true);
  return restart_from(experiment, std::move(initial), t);
}

EventResets::EventResets(const Experiment& experiment, std::size_t first)
    : experiment_(experiment) {
  auto place = static_cast<Index>(first);
  for (const Event& event : experiment.events) {
    places_.push_back(place);
    place += std::ssize(event.resets);
    if (event.sets_velocities()) place += experiment.model.system->manifold()->ambient_dimension();
  }
}

std::optional<Restart> EventResets::operator()(std::size_t event, const State& at,
                                               const VectorXd& row) const {
  const std::vector<Event::Reset>& resets = experiment_.events[event].resets;
  const auto values = row.segment(places_[event], std::ssize(resets));
  InitialValues initial = nothing_given(experiment_);
  initial.x.values = at.x;
  initial.x.given.setConstant(true);
  const ImplicitSystem::Names& names = experiment_.model.system->names();
  const Index N = at.x.size();
  if (experiment_.events[event].sets_velocities()) {
    initial.velocity.values = row.segment(places_[event] + std::ssize(resets), N);
    for (Index i = 0; i < N; ++i)
      if (const auto momentum = names.momentum_of(i)) {
        initial.velocity.given[i] = true;
        initial.x.given[*momentum] = false;
      }
  }
  for (std::size_t i = 0; i < resets.size(); ++i) {
    const double value = values[static_cast<Index>(i)];
    if (!std::isfinite(value))
      throw std::domain_error("The event " + experiment_.events[event].name +
                              " at t = " + number_text(at.t) + " sets " +
                              names.coordinates[static_cast<std::size_t>(resets[i].coordinate)] +
                              (resets[i].is_velocity ? "'" : "") + " to " + number_text(value) +
                              "; expected a number.");
    PartialVector& vector = resets[i].is_velocity ? initial.velocity : initial.x;
    vector.values[resets[i].coordinate] = value;
    vector.given[resets[i].coordinate] = true;
  }
  return restart_from(experiment_, std::move(initial), at.t);
}

}  // namespace courant
