// StepFormulas: the equations that a step solves, as formulas.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "courant/core/algebra/elimination.hpp"
#include "courant/core/expressions/function.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

class EquationSystem;

// F(y; p) = 0 for the unknowns y of a step, with names: what a solver is compiled from, and what explains
// or exports it.
struct StepFormulas {
  std::string name;
  Graph graph;                          // of all the expressions
  std::vector<Function::Input> inputs;  // y, then the groups of p
  ExprVector equations;
  std::vector<std::vector<std::string>> input_names;  // of each variable of each group
  std::vector<std::string> equation_names;
  bool eliminates = true;
  Elimination::Options elimination;
  // Equations that are none of these any more: since they follow from the others; or since they decide unknowns
  // only that nothing depends on. Such unknowns that are held, and at what.
  std::vector<std::string> redundant, left_out, held;
  std::vector<double> held_values;

  EquationSystem compile(Backend backend) const;
  // y; p ↦ F with its Jacobian by y, interpreted.
  Function whole() const;
  // What shows whether a solution of these equations, which compile() made, is connected to the state: all equations
  // for all unknowns; empty where they are affine, and have one solution at most, and where an engine solves them.
  Function followed(const EquationSystem& compiled) const;
  // The variables of a group that equations contain, by their number in it, ascending.
  std::vector<Index> contained(std::size_t group) const;
  // Whether F is affine in y: then it has one solution at most, if its matrix is regular.
  bool is_affine() const;
};

// "q''" for the second derivative of q.
std::string derivative_name(const std::string& name, Index order);

// What elimination takes out of the equations and why, and what it leaves, in lines of at most `width`
// columns, long formulas cut off:
//
//   constrain-first: 48 equations for 48 unknowns
//     left out: …                  (they follow from others, or nothing depends on what they decide)
//     q' = 2*Δq/h                  from: start of q
//     …
//   8 equations are left, for Δq, …
std::string explanation(const StepFormulas& formulas, std::size_t width = 100);

}  // namespace courant
