// LimitedNewton: Newton's method for equations with exponentials, from far away.
#pragma once

#include <memory>
#include <vector>

#include "courant/core/exponentials.hpp"
#include "courant/core/linear_solver.hpp"

namespace courant {

// Solves L(y; p, ā) = 0 by one step of Newton's method, moves ā to the arguments of that y
// (Exponentials::move), and so on, until they agree. As L asks for no more than the tangents of exponentials
// do, no step overflows, and down the flank of one no step is as short as its argument's unit.
// For second tries: where F has several zeros the one that is found need not be the one that is meant. Holds
// workspace.
class LimitedNewton {
 public:
  explicit LimitedNewton(Exponentials exponentials);

  const Exponentials& exponentials() const { return exponentials_; }

  // From the arguments at y. in[0] is where y is read and written, in[1] … are the parameters.
  // False, with y anywhere: it does not settle.
  bool solve(double* y, const double* const* in);

 private:
  bool move(double* y, const double* const* in);

  Exponentials exponentials_;
  std::vector<Index> contained_;
  std::unique_ptr<LinearSolver> solver_;
  std::vector<const double*> in_;
  VectorXd held_, arguments_, all_, step_;
};

}  // namespace courant
