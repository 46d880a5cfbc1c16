// The same pendulum three ways: by its angle, in the plane with a rod, and as a port-Hamiltonian
// system. What is different is the geometry that one writes down; the motion is one.
#include <cmath>
#include <courant/courant.hpp>
#include <cstdio>
#include <memory>

using namespace courant;

// Released at rest at the angle 2 from below, observed at t = 1.
constexpr double start_angle = 2.0, end_time = 1.0;
constexpr int steps = 200;

// 1. By its angle q: H = p²/2 - cos q on T*R. No constraint; index 0.
double by_its_angle() {
  const auto Q = std::make_shared<Euclidean>(1);
  const auto phase_space = std::make_shared<CotangentBundle>(Q);
  const auto system = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(phase_space),
      std::make_shared<Hamiltonian>(phase_space, [](const ExprVector& x, const Expr&) {
        return square(x[1]) / 2.0 - cos(x[0]);
      }));
  const auto map = std::make_shared<CotangentLift>(phase_space, std::make_shared<Theta>(Q));
  const auto stepper =
      DiscretizeFirst(system, map).start({.x = VectorXd{{start_angle, 0.0}}}, end_time / steps);
  for (int k = 0; k < steps; ++k) stepper->step();
  return stepper->state().x[0];
}

// E(q, p, λ) = |p|²/2 + q₁ + λ (|q|² - 1)/2: a Hamiltonian and the length of the rod, with the
// tension λ. ∂E/∂λ = 0 is the constraint.
class Rod final : public GeneratingFamily {
 public:
  explicit Rod(std::shared_ptr<const CotangentBundle> phase_space)
      : GeneratingFamily(phase_space, 1) {}

 private:
  Expr do_value(const ExprVector& x, const ExprVector& tension, const Expr&) const override {
    const Expr kinetic = (square(x[2]) + square(x[3])) / 2.0;
    const Expr length = square(x[0]) + square(x[1]) - 1.0;
    return kinetic + x[1] + tension[0] * length / 2.0;
  }
};

// 2. In the plane, on T*R²: the constraint algorithm finds that the velocity is at right angles to
//    the rod, and what the tension is; Method 2 keeps both constraints. Index 2.
double with_a_rod() {
  const auto Q = std::make_shared<Euclidean>(2);
  const auto phase_space = std::make_shared<CotangentBundle>(Q);
  const auto system = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(phase_space), std::make_shared<Rod>(phase_space));
  const VectorXd start{{std::sin(start_angle), -std::cos(start_angle), 0.0, 0.0}};
  const ConstraintLadder ladder = ConstraintAlgorithm().run(system, {.x = start});
  std::printf("with a rod: index %d, %d degrees of freedom, tension at the start %.4f\n",
              static_cast<int>(ladder.index), static_cast<int>(ladder.degrees_of_freedom),
              ladder.point.z[0]);
  const auto map = std::make_shared<CotangentLift>(phase_space, std::make_shared<Theta>(Q));
  const ConstrainFirst method(system, ladder, map, std::make_shared<OrthogonalProjector>());
  const auto stepper = method.start(ladder.point, end_time / steps);
  for (int k = 0; k < steps; ++k) stepper->step();
  const VectorXd& x = stepper->state().x;
  return std::atan2(x[0], -x[1]);
}

// 3. As a port-Hamiltonian system, x = (q, p), x' = (J - R) dH, without resistance: R = 0. A
//    resistance or a port would be one more matrix.
double as_a_port_hamiltonian_system() {
  const auto M = std::make_shared<Euclidean>(2);
  const auto field = [](const MatrixXd& matrix) {
    return [matrix](const ExprVector&) { return constants(matrix); };
  };
  const PortHamiltonianSystem::Matrices matrices{
      .J = field(MatrixXd{{0.0, 1.0}, {-1.0, 0.0}}), .R = {}, .B = field(MatrixXd(2, 0)), .m = 0};
  const auto energy = std::make_shared<Hamiltonian>(
      M, [](const ExprVector& x, const Expr&) { return square(x[1]) / 2.0 - cos(x[0]); });
  const auto system = std::make_shared<PortHamiltonianSystem>(matrices, energy, std::nullopt);
  const auto stepper = DiscretizeFirst(system, std::make_shared<Theta>(M))
                           .start({.x = VectorXd{{start_angle, 0.0}}}, end_time / steps);
  for (int k = 0; k < steps; ++k) stepper->step();
  return stepper->state().x[0];
}

int main() {
  const double canonical = by_its_angle();
  const double holonomic = with_a_rod();
  const double ports = as_a_port_hamiltonian_system();
  std::printf("angle at t = 1: %.4f by its angle, %.4f with a rod, %.4f port-Hamiltonian\n",
              canonical, holonomic, ports);
  // The first and the third are one map, the midpoint rule; the second is another method of order
  // 2, whose error is of the size of the square of the step.
  return std::abs(canonical - ports) < 1e-12 && std::abs(canonical - holonomic) < 1e-4 ? 0 : 1;
}
