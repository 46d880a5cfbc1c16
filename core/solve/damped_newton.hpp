// Newton's method from far away, by damped steps.
#pragma once

#include <functional>

#include "courant/core/linear/linear_solver.hpp"

namespace courant {

// F(y) = 0 as damped_newton() asks for it.
struct DampedEquations {
  // Keeps factors of the Jacobian J at y. False if it is not finite.
  std::function<bool(const VectorXd& y)> linearize;
  // J⁺ F(y) with the factors that are kept. False if it is not finite.
  std::function<bool(const VectorXd& y, VectorXd& correction)> correct;
  // Sizes of consecutive blocks of y, each measured by its own scale, and nominal sizes of them (the
  // values and corrections of a block count too).
  std::vector<Index> groups;
  VectorXd scales;
};

// Leads y to where full steps of Newton's method contract, or to a zero of F. A step
//
//   y ← y - λ J⁺ F(y),   0 < λ ≤ 1,
//
// is taken if the next correction, by the same J, is shorter (the natural monotonicity test, which
// linear combinations of the equations do not change); λ is the longest that is expected to do so.
// Source: Deuflhard, Newton Methods for Nonlinear Problems (2004), Algorithm NLEQ-ERR; but λ shrinks
// to no less than a tenth at once: behind an exponential, what is expected of λ is worth nothing.
//
// For second tries: a zero that is found from far away need not be the one that is meant. False, with
// y where the search ended, if no step is short enough, or after `iterations` of them.
bool damped_newton(const DampedEquations& equations, VectorXd& y, int iterations = 100);

}  // namespace courant
