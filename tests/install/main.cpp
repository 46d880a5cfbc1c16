// A pendulum's force from its energy, in ten lines: what a program that uses Courant starts with.
#include <Eigen/Core>
#include <cmath>
#include <iostream>
#include <type_traits>
#include <utility>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/function.hpp"
#include "courant/manifolds/sphere.hpp"

// What a product of the program's own matrices is stays Eigen's to say.
namespace own {
using namespace courant;
using Matrix = Eigen::MatrixXd;
static_assert(std::is_same_v<decltype(std::declval<Matrix&>() * std::declval<Matrix&>()),
                             decltype(std::declval<Matrix&>().operator*(std::declval<Matrix&>()))>);
}  // namespace own

int main() {
  courant::Graph graph;
  const courant::ExprVector x = graph.variables("x", 2);  // (q, p)
  const courant::Expr energy = square(x[1]) / 2 - cos(x[0]);
  const courant::Function gradient("gradient", {{"x", x}}, courant::gradient(energy, x));

  const Eigen::VectorXd force = -gradient({Eigen::Vector2d(0.5, 0.25)});
  const double defect = std::abs(force[0] + std::sin(0.5)) + std::abs(force[1] + 0.25);
  std::cout << "defect of the gradient: " << defect << '\n';

  // Matrices that one side allocates and the other one frees or resizes.
  const courant::Sphere sphere(2);
  Eigen::MatrixXd basis = sphere.tangent_basis(Eigen::Vector3d(0.6, 0.0, 0.8));
  const double angle = (basis.transpose() * Eigen::Vector3d(0.6, 0.0, 0.8)).norm();
  basis.conservativeResize(3, 9);
  basis = sphere.tangent_basis(Eigen::Vector3d(0.0, 0.0, 1.0));
  return defect <= 1e-15 && angle <= 1e-15 ? 0 : 1;
}
