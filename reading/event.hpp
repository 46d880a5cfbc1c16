// Event: a quantity of a run whose zeros are located.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "courant/reading/model.hpp"

namespace courant {

// An entry of `events`, by name: a formula of coordinates, velocities, unknowns and t, and which of
// its zeros count.
struct Event {
  enum class Direction { rising, falling, either };
  // What a coordinate, or the velocity of one, is from a zero on: a formula of what there is at it.
  struct Reset {
    Index coordinate = 0;
    bool is_velocity = false;
    WrittenFormula value = {};
  };
  std::string name;
  WrittenFormula formula;
  Direction direction = Direction::either;
  bool stops = false;  // the run ends with the first of its zeros
  std::vector<Reset> resets = {};

  bool sets() const { return !resets.empty(); }
  bool sets_velocities() const;

  // Whether the quantity passes through zero between two values, the first of which is not zero: a
  // zero that is a value itself ends one interval, and does not begin the next.
  bool is_between(double before, double after) const;
  // Whether a value lies where such a zero leads to, for `either` any.
  bool is_beyond(double value) const;
};

// Reads the object `events`. An entry is a formula, for zeros in both directions, or
//
//   {"zero": "x*p_x + y*p_y", "direction": "rising", "stop": true}
//
// or, where a ball hits the ground, {"zero": "y", "direction": "falling", "set": {"y'": "-0.8*y'"}}.
std::vector<Event> read_events(const JsonReader& events, const Model& model);

// The pointer of what the first of these sets; nothing where none sets anything.
std::optional<std::string> place_of_resets(const std::vector<Event>& events);

}  // namespace courant
