// LimitedNewton: Newton's method for equations with exponentials, from far away.
#pragma once

#include <memory>
#include <vector>

#include "courant/core/expressions/inputs.hpp"
#include "courant/core/linear/linear_solver.hpp"
#include "courant/core/solve/exponentials.hpp"

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

  // From the arguments at the unknowns y of `in`. False, with y anywhere: it does not settle. Throws as
  // Newton::solve does.
  bool solve(const Inputs& in);

 private:
  bool move(const Inputs& in);

  Exponentials exponentials_;
  std::vector<Index> contained_;
  std::unique_ptr<LinearSolver> solver_;
  VectorXd held_, arguments_, all_, step_;
};

}  // namespace courant
