// The key `sensitivities` of an experiment.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "courant/core/expressions/graph_parameters.hpp"
#include "courant/reading/initial_values.hpp"
#include "courant/reading/model.hpp"

namespace courant {

// Derivatives of quantities of a run, each by each of some parameters and initial values:
//
//   {"by": ["L", "x"], "of": ["H", "x"]}      columns dH/dL, dH/dx(0), dx/dL, dx/dx(0)
struct Sensitivities {
  struct By {
    std::string name;     // "L", "k[1]", "x"
    std::string pointer;  // in the experiment
    // Of an initial value; none for a parameter, which has this value.
    std::optional<Index> coordinate = {};
    double value = 0.0;
  };
  std::vector<By> by;
  std::vector<std::string> of;  // coordinates, H, momenta of symmetries, observables

  // Those of `by` that are parameters, in their order.
  std::vector<Parameter> parameters() const;
  // By quantity, then by what it is differentiated by.
  std::vector<std::string> columns() const;
};

// What an experiment has that names may stand for.
struct SensitivityWords {
  const Model& model;
  const InitialValues& initial;
  std::vector<std::string> momenta;      // of symmetries
  std::vector<std::string> observables;  // of the state
  std::vector<std::string> others;       // observables at stages and of energies of the run
};

// Makes a problem of each name that stands for nothing. The name of an array stands for all its entries.
std::optional<Sensitivities> read_sensitivities(const JsonReader& value,
                                                const SensitivityWords& words);

}  // namespace courant
