// One step of a discretization map, next to what it approximates.
#pragma once

#include <random>

#include "courant/core/expressions/function.hpp"
#include "courant/integrators/maps/discretization_map.hpp"

namespace courant {

// A nonlinear vector field on M that depends on time, f(x, t) = Π(x) A sin(x + b + c t), one step
// of a discretization map on it, from t = 0, and its flow by the classical Runge–Kutta method on ẋ
// = E f with many small steps.
class OneStep {
 public:
  // Draws A, b and c. The map has to outlive it.
  OneStep(const DiscretizationMap& map, const VectorXd& x0, std::mt19937& generator);

  // Distance between the step of size h and the flow: falls like h^(p+1) for a map of order p.
  double error(double h) const;

 private:
  VectorXd step(double h) const;
  VectorXd flow(double time) const;

  const Manifold& M_;
  VectorXd x0_;
  Function flow_;
  Function step_;
};

}  // namespace courant
