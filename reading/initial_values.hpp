// The initial values of an experiment, in full or in part.
#pragma once

#include <optional>
#include <vector>

#include "courant/reading/model.hpp"
#include "courant/reading/nominal_sizes.hpp"

namespace courant {

// Yes or no for each entry of a vector.
using Flags = Eigen::Array<bool, Eigen::Dynamic, 1>;

// The places of those that say yes, ascending.
std::vector<Index> indices(const Flags& flags);

// Entries of a vector that are given, and that must not be moved; 0, or where to begin, where they are not given.
struct PartialVector {
  VectorXd values;
  Flags given;
  Flags held;

  explicit PartialVector(Index size = 0);
};

// A quantity that is neither a coordinate, a velocity nor an unknown: the voltage of a capacitor, a momentum, a
// definition.
struct GivenQuantity {
  WrittenFormula formula;  // its name
  double value = 0.0;
  bool held = false;
};

// What an experiment gives of its start, whole or in part.
struct InitialValues {
  PartialVector x;         // N
  PartialVector velocity;  // dx/dt, N
  PartialVector z;         // m, where unknowns have names
  VectorXd weight;  // N: coordinates that must move do so with the least Σ weight · movement²
  std::vector<GivenQuantity> quantities = {};
  NominalSizes nominal = {};

  // Of coordinates (N) and unknowns that must move, in Σ cost · movement²: their weights next to the squares of their
  // nominal sizes, 1 for each that is not given.
  VectorXd cost_of_coordinates() const;
  VectorXd cost_of_unknowns() const;
};

// Reads `initial`, an object such as {"x": [-1, 1], "y[0]": 2, "x'": "v0/2"}: an array name takes
// an array, values may be formulas of the parameters. `hold` is the array beside it, of names that
// are given; `weights` an object of names and positive numbers, 1 for what is not in it,
// `nominal` one of names and the sizes of NominalSizes, an array of them for an array. The
// pointers of what is wrong are those of the entries. Every quantity that can be observed may be given.
//
// "rest", or `"rest": true` in the object: velocities that are not given are 0. Those are dx/dt of the base of a
// cotangent bundle, of a matrix of rotation where neither an entry of its momentum nor its angular velocity is given,
// and coordinates v that an equation `x' - v` says to be velocities. Of a model that starts at 0 nothing has to be one.
std::optional<InitialValues> read_initial_values(const JsonReader& initial,
                                                 const std::optional<JsonReader>& hold,
                                                 const std::optional<JsonReader>& weights,
                                                 const std::optional<JsonReader>& nominal,
                                                 const Model& model);

}  // namespace courant
