// The initial values of an experiment, in full or in part.
#pragma once

#include <optional>

#include "courant/reading/model.hpp"

namespace courant {

// Entries of a vector that are given, and that must not be moved; 0 where they are not given.
struct PartialVector {
  VectorXd values;
  Eigen::Array<bool, Eigen::Dynamic, 1> given;
  Eigen::Array<bool, Eigen::Dynamic, 1> held;

  explicit PartialVector(Index size = 0);
};

struct InitialValues {
  PartialVector x;         // N
  PartialVector velocity;  // dx/dt, N
  PartialVector z;         // m, where unknowns have names
  VectorXd weight;  // N: coordinates that must move do so with the least Σ weight · movement²
};

// Reads `initial`, an object such as {"x": [-1, 1], "y[0]": 2, "x'": "v0/2"}: an array name takes
// an array, values may be formulas of the parameters. `hold` is the array beside it, of names that
// are given; `weights` an object of names and positive numbers, 1 for what is not in it. The
// pointers of what is wrong are those of the entries.
std::optional<InitialValues> read_initial_values(const JsonReader& initial,
                                                 const std::optional<JsonReader>& hold,
                                                 const std::optional<JsonReader>& weights,
                                                 const Model& model);

}  // namespace courant
