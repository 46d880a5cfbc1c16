// Ensemble: many starts of one experiment.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "courant/reading/model.hpp"

namespace courant {

// The members of an ensemble: a row of numbers for each, which stand in the place of initial values and parameters
// of one experiment.
//
//   "ensemble": {"table": "starts.csv"}                    names in the first line, then a member a line (load_tables)
//   "ensemble": {"values": {"q": [1, 0.5], "k": [1, 4]}}   the same in the experiment
//   "ensemble": {"members": 1000, "seed": 1, "random": {"g": "normal"},
//                "values": {"q": "1 + 0.1*g", "k": "2 + i/10"}}
//
// Formulas are of the number i = 0, 1, … of the member, of random numbers, and of the parameters of the experiment. A
// random number depends on seed, name and i alone (RandomNumbers).
struct Ensemble {
  static constexpr Index kMostMembers = 10'000'000;

  std::vector<std::string> names;  // "q", "x[0]", "k"
  std::vector<std::string>
      pointers;     // where their values stand: "/initial/x/0", "/system/parameters/k"
  MatrixXd values;  // members × names

  Index members() const { return values.rows(); }
};

// Reads the object `ensemble` of a document with this model. What is wrong is a problem, and there is nothing then.
std::optional<Ensemble> read_ensemble(const JsonReader& value, const Json& document,
                                      const Model& model);

}  // namespace courant
