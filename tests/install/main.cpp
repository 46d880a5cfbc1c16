// A pendulum's force from its energy, in ten lines: what a program that uses Courant starts with.
#include <cmath>
#include <iostream>

#include "courant/core/derivative.hpp"
#include "courant/core/function.hpp"

int main() {
  courant::Graph graph;
  const courant::ExprVector x = graph.variables("x", 2);  // (q, p)
  const courant::Expr energy = square(x[1]) / 2 - cos(x[0]);
  const courant::Function gradient("gradient", {{"x", x}}, courant::gradient(energy, x));

  const Eigen::VectorXd force = -gradient({Eigen::Vector2d(0.5, 0.25)});
  const double defect = std::abs(force[0] + std::sin(0.5)) + std::abs(force[1] + 0.25);
  std::cout << "defect of the gradient: " << defect << '\n';
  return defect <= 1e-15 ? 0 : 1;
}
