// Equations with one parameter, for tests of Newton's method.
#pragma once

#include "courant/core/solve/newton.hpp"

namespace courant {

struct NewtonProblem {
  Function function;
  VectorXd y;
  double parameter = 0.0;
  Newton::Result solve(Newton& newton, double scale = 0.0) {
    const Inputs in(y.data(), {&parameter});
    return newton.solve(in, &scale);
  }
};

template <class Formula>
NewtonProblem newton_problem(Index size, const Formula& formula) {
  Graph graph;
  const ExprVector y = graph.variables("y", size);
  const ExprVector a = graph.variables("a", 1);
  return {Function("problem", {{"y", y}, {"a", a}}, formula(y, a[0]), {.differentiate = {"y"}}),
          VectorXd::Zero(size)};
}

}  // namespace courant
