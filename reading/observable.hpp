// A formula that is written with each row of a run.
#pragma once

#include <string>

#include "courant/reading/written_formula.hpp"

namespace courant {

// A named function of the state that a run writes beside the coordinates.
struct Observable {
  std::string name;
  // Of coordinates, velocities, unknowns, t; of energies since the beginning, but at a stage.
  WrittenFormula formula;
  bool at_stage = false;       // of the step that ended at the state
  bool uses_energies = false;  // of the run
};

}  // namespace courant
