// The key `symmetries` of an experiment.
#pragma once

#include <string>
#include <vector>

#include "courant/reading/model.hpp"
#include "courant/structures/symmetry.hpp"

namespace courant {

// An entry of `symmetries`: the name of its momentum, and the generator. That it is a symmetry is
// measured where the consistent point is known, by check_symmetries.
struct DeclaredSymmetry {
  std::string name;
  std::string pointer;
  Symmetry symmetry;
};

// Reads the object `symmetries` of a system on T*Q with its canonical structure. An entry is a
// vector field on Q: by coordinate the rates of its elements, formulas of the coordinates, 0 for
// what is not named; on groups v_<name> takes components of the tangent vector instead:
//
//   "L": {"x": "-y", "y": "x"}      "axis": {"v_R": [0, 0, 1]}
std::vector<DeclaredSymmetry> read_symmetries(const JsonReader& symmetries, const Model& model);

}  // namespace courant
