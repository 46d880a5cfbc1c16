// A discretization map of one's own, what the library then measures of it, and a method built on
// it.
#include <cmath>
#include <iostream>

#include "courant/integrators/maps/laws.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/manifolds/hyperbolic.hpp"

using namespace courant;

// The Lorentz product -x[0] y[0] + x[1] y[1] + … + x[n] y[n].
Expr lorentz(const ExprVector& x, const ExprVector& y) { return x.dot(y) - 2.0 * x[0] * y[0]; }

ExprVector normalised(const ExprVector& x) { return x / sqrt(-lorentz(x, x)); }

// Chords of the hyperboloid, as equation (2) of the paper has them on the sphere:
//
//   R_d(x, v) = (x - v/2, x + v/2), each divided by its Lorentz length.
//
// Both ends are on the hyperboloid while ⟨v, v⟩ < 4. With s = x₀ + x₁ the inverse is
//
//   x = s / |s|,   v = 2 (x₁ - x₀) / |s|.
class HyperbolicChord final : public DiscretizationMap {
 public:
  explicit HyperbolicChord(std::shared_ptr<const Hyperbolic> space)
      : DiscretizationMap("HyperbolicChord", std::move(space)) {}

  int order() const override { return 2; }
  bool is_symmetric() const override { return true; }
  double domain_radius() const override { return 2.0; }

 private:
  PointPair<Expr> do_forward(const ExprVector& x, const ExprVector& v) const override {
    return {normalised(x - v / 2.0), normalised(x + v / 2.0)};
  }
  TangentVector<Expr> do_inverse(const ExprVector& x0, const ExprVector& x1) const override {
    const ExprVector sum = x0 + x1;
    const Expr length = sqrt(-lorentz(sum, sum));
    return {sum / length, 2.0 * (x1 - x0) / length};
  }
};

// The rotation about the axis of the hyperboloid: v = (0, -x[2], x[1]).
class Rotation final : public ImplicitSystem {
 public:
  explicit Rotation(std::shared_ptr<const Manifold> plane)
      : ImplicitSystem(std::move(plane), 0, 3, {}) {}

 private:
  ExprVector do_residual(const ExprVector& x, const ExprVector& v, const ExprVector&,
                         const Expr&) const override {
    ExprVector turning(3);
    turning << 0.0, -x[2], x[1];
    return v - turning;
  }
};

int main() {
  const auto plane = std::make_shared<Hyperbolic>(2);
  const auto map = std::make_shared<HyperbolicChord>(plane);
  const auto laws = check_discretization_map(*map);
  for (const LawResult& law : laws) std::cout << law << '\n';

  const DiscretizeFirst method(std::make_shared<Rotation>(plane), map);
  const VectorXd start = plane->retract(Eigen::Vector3d(1.0, 0.0, 0.0), Eigen::Vector3d(0, 1, 0));
  // How far the method is from the rotation by the angle 1 after so many steps.
  const auto error = [&](int steps) {
    const VectorXd end = method.advance({.x = start}, 1.0 / steps, steps).x;
    const double radius = start[1];
    const Eigen::Vector3d exact(start[0], radius * std::cos(1.0), radius * std::sin(1.0));
    return (end - exact).norm();
  };
  const double ratio = error(20) / error(40);
  std::cout << "half the step, error divided by " << ratio << '\n';
  return all_passed(laws) && std::abs(ratio - 4.0) < 0.1 ? 0 : 1;
}
