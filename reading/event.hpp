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
  std::string name;
  WrittenFormula formula;
  Direction direction = Direction::either;
  bool stops = false;  // the run ends with the first of its zeros

  // Whether the quantity passes through zero between two values, the first of which is not zero: a
  // zero that is a value itself ends one interval, and does not begin the next.
  bool is_between(double before, double after) const;
};

// Reads the object `events`. An entry is a formula, for zeros in both directions, or
//
//   {"zero": "x*p_x + y*p_y", "direction": "rising", "stop": true}
std::vector<Event> read_events(const JsonReader& events, const Model& model);

}  // namespace courant
