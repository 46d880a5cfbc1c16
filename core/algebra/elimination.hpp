// Elimination: unknowns that equations give explicitly are taken out of them.
#pragma once

#include <vector>

#include "courant/core/expressions/expr.hpp"

namespace courant {

// Equations F(y; p) = 0 in which some unknowns are explicit. If
//
//   F_i = a y_j + g,   a ≠ 0 made of numbers and of parameters that are never zero,
//                      g free of y_j,
//
// then y_j = -g / a may be put into the other equations, and F_i is done with. Again and again, this
// leaves equations G in the unknowns u that are kept, and all unknowns as functions Y of those:
//
//   F(y; p) = 0   if and only if   G(u; p) = 0 and y = Y(u; p),     u = (y_j), j in `kept`
//
// The Jacobian of G is the Schur complement in that of F, so Newton's method makes the same iterates.
//
// A pivot a may be small next to the other coefficients of its equation, in comparable units, only if
// y_j is in no other equation; so elimination loses no digits. Sums are written without terms that
// meet, see collected(). Among those that are allowed the order is
// Markowitz's: the one first whose removal couples fewest of the others (Duff, Erisman & Reid, Direct
// Methods for Sparse Matrices, 2017, Section 7.2). Of many equations, pivots that would fill them are
// left alone.
struct Elimination {
  struct Pivot {
    Index equation, unknown;
  };
  struct Options {
    // Parameters that are never zero, as a step size.
    ExprVector never_zero = {};
    // How coarsely each unknown is measured (empty: all alike). None is given by an equation that contains
    // a coarser one: an iteration that ends when the kept unknowns are known to their accuracy knows the
    // others to theirs.
    std::vector<int> coarseness = {};
    // Whether y_j may be divided by an a that varies with other unknowns, where F_i alone contains y_j in the end:
    // the caller knows that the equations are regular. A multiplier of a hidden constraint is such an unknown.
    bool is_regular = false;
  };

  // Throws std::invalid_argument if an unknown is no variable, or the coarseness does not fit.
  Elimination(const ExprVector& equations, const ExprVector& unknowns, const Options& options);

  std::vector<Pivot> pivots;  // in the order of their elimination
  // Equations that are left, ascending; none that reads 0 = 0, nor one that says so for all values of its
  // variables, as an equation does that repeats those that were put into it.
  std::vector<Index> remaining;
  std::vector<Index> kept;  // unknowns that are left, ascending
  ExprVector equations;     // G, one for each of `remaining`
  ExprVector unknowns;      // Y, one for each unknown, in those of `kept` and the parameters

 private:
  void take_last_ones(const ExprVector& y, const std::vector<int>& coarseness);
};

}  // namespace courant
