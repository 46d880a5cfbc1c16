// Constraints as formulas, where elimination by hand would find them.
#pragma once

#include <string>
#include <vector>

#include "courant/integrators/ladder/constraint_ladder.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

struct ConstraintFormulas {
  struct Constraint {
    Index level;
    std::string formula;  // that vanishes on M_level
  };
  struct Value {
    Index unknown;        // auxiliary
    std::string formula;  // of coordinates and time
  };
  std::vector<Constraint> constraints;
  std::vector<Value> values;
};

// What one finds with pencil and paper: equations are solved for velocities and auxiliary unknowns
// that occur in them linearly, with a constant coefficient or one that does not vanish at the
// point, and put into the others; an equation without unknowns left is a constraint, and its time
// derivative the next equation. Formulas are kept if they vanish at the point, add a direction to
// the gradients of those before them, and are no longer than a line. For coordinates on Rⁿ (and
// T*Rⁿ) and up to 80 velocities and unknowns; nothing otherwise. `ladder` has an index.
ConstraintFormulas constraint_formulas(const ImplicitSystem& system,
                                       const ConstraintLadder& ladder);

}  // namespace courant
