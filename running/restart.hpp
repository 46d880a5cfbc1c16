// Where a motion goes on from after a jump.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "courant/integrators/step/step.hpp"
#include "courant/reading/experiment.hpp"

namespace courant {

// A consistent state behind a jump, and what the constraints moved beside what was set: "p_x from 0 to 0.3".
struct Restart {
  State state;
  std::string moves = {};
  bool is_impulse = false;  // these moves are those of an impulse
};

// The consistent state at time t that impulses lead to from the coordinates of this one; nothing where there is
// none.
std::optional<Restart> restart(const Experiment& experiment, const State& before, double t);

// What events set (Event::resets).
class EventResets {
 public:
  // `experiment` outlives this. `first`: Observer::first_reset().
  EventResets(const Experiment& experiment, std::size_t first);

  // The state behind a zero of the event with this number, where `row` is measured: what the event sets is set, all
  // other coordinates are as they were, and from there impulses lead to a consistent state. Where velocities are set,
  // momenta follow from all velocities. Nothing where there is no such state. Throws std::domain_error where a value is
  // not finite.
  std::optional<Restart> operator()(std::size_t event, const State& at, const VectorXd& row) const;

 private:
  const Experiment& experiment_;
  std::vector<Index> places_;  // in a row, of each event
};

}  // namespace courant
