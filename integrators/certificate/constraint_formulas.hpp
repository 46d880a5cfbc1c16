// The constraint algorithm as one does it by hand, where that works.
#pragma once

#include <string>
#include <vector>

#include "courant/core/expressions/graph_parameters.hpp"
#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

// Formulas are in the names of the system, simplified, and hold on its manifold.
struct ConstraintFormulas {
  struct Constraint {
    Index level;
    std::string formula;       // that vanishes on M_level
    bool is_singular = false;  // its differential vanishes at the point
  };
  struct Value {
    Index unknown;        // auxiliary
    std::string formula;  // of coordinates and time
  };
  // A component of the velocity that is a function of the point from this level on.
  struct Velocity {
    Index component;
    Index level;
    std::string formula;
    std::string on_M_f = {};  // where constraints of later levels make it simpler
  };
  // What S_level adds to the level before: a function that vanishes on M_{level-1}, differentiated.
  struct Step {
    enum class Kind {
      constraint,     // nothing but coordinates is left
      condition,      // on velocities and unknowns
      kept,           // 0 = 0: the constraint is kept
      contradiction,  // 1 = 0
    };
    Index level;
    Kind kind;
    std::string constraint;  // φ
    std::string derivative;  // dφ/dt, in velocities
    std::string result;      // dφ/dt with what is known of the velocities put in
  };
  std::vector<Constraint> constraints;
  std::vector<Value> values;
  std::vector<Velocity> velocities;
  std::vector<Step> steps;
  // The constraints and the values as expressions, in the same order, of coordinates (N) and time, which have the
  // names of the system, and of parameters (graph_parameters.hpp).
  std::vector<Expr> constraint_functions = {}, value_functions = {};
  ExprVector coordinates = {};
  Expr time = {};
  std::vector<Parameter> parameters = {};  // of their graph
};

std::string to_string(ConstraintFormulas::Step::Kind kind);

// The constraint algorithm as a calculation by hand does it. An equation in which a velocity or an
// auxiliary unknown is linear, with a coefficient that is constant or does not vanish at the point, is
// solved for it, and the result is put into the others. An equation in which no unknown is left is a
// constraint, and its time derivative is the next equation. Constraints are kept if they vanish at the point and add a
// direction to the gradients of those before them. Where ranks tell of more constraints, polynomial
// elimination looks for them: p = v/|v| has the consequence |p| = 1. What takes more than a few lines is
// left out. For up to 200 velocities and unknowns; nothing otherwise.
//
// `ladder` has an index; or its rank changes, and constraints may be singular; or it is inconsistent, and
// the last step may be a contradiction: that of a derivative, or of constraints without a common zero, the
// last of which it names.
//
// Formulas have these parameters by name, where as much is found so as with their numbers: that two of them are equal,
// names do not tell. Those that are 0, or count the terms of a sum, are numbers. Names are those of elements: "l",
// "m[1]".
ConstraintFormulas constraint_formulas(const ImplicitSystem& system, const ConstraintLadder& ladder,
                                       std::vector<Parameter> parameters = {});

// Names of the components of the velocity (Ñ) in the representation of the manifold: x' of a
// coordinate x that is one of them; else v_R[0] of R[3][3], or v[0].
std::vector<std::string> velocity_names(const ImplicitSystem& system);

}  // namespace courant
