#include "courant/integrators/methods/discrete_gradient.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "../example_systems.hpp"
#include "courant/integrators/maps/chordal.hpp"
#include "courant/integrators/maps/cotangent_lift.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/integrators/step/step_energies.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/constrained_family.hpp"
#include "courant/structures/dirac_system.hpp"
#include "courant/structures/network.hpp"
#include "courant/structures/port_hamiltonian_system.hpp"

// Mistakes that these cases have to notice:
//  * a holonomic constraint holds in the middle
BOOST_AUTO_TEST_SUITE(discrete_gradient_test)

using namespace courant;

namespace {

using V = const ExprVector&;
using T = const Expr&;

const std::vector<std::shared_ptr<const DiscreteDifferential>> kinds = {
    std::make_shared<GonzalezDifferential>(), std::make_shared<AveragedDifferential>(),
    std::make_shared<ItohAbeDifferential>()};

std::shared_ptr<const DiracSystem> oscillator(Hamiltonian::Formula H) {
  const auto M = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(1));
  return std::make_shared<DiracSystem>(std::make_shared<CanonicalSymplectic>(M),
                                       std::make_shared<Hamiltonian>(M, std::move(H)));
}
// x⁴/4 as the potential.
std::shared_ptr<const DiracSystem> quartic() {
  return oscillator([](V x, T) { return square(x[1]) / 2.0 + square(square(x[0])) / 4.0; });
}

// The greatest |H - H(0)|.
double drift(const Integrator& method, const StepEnergies& energies, State state, double h,
             int steps) {
  const auto stepper = method.stepper();
  const double first = energies.energy(state);
  double worst = 0.0;
  for (int k = 0; k < steps; ++k) {
    stepper->step(state, h);
    worst = std::max(worst, std::abs(energies.energy(state) - first));
  }
  return worst;
}

}  // namespace

// Section 7.1, end: of Method 1 ⟨dH, R_d⁻¹⟩ = 0, and H changes by 3e-4; a discrete gradient keeps H.
BOOST_AUTO_TEST_CASE(exact_energy) {
  const auto system = quartic();
  const auto map = std::make_shared<Theta>(system->manifold());
  const StepEnergies energies(system);
  const State start{.x = VectorXd{{1.0, 0.0}}};
  const double of_method_1 = drift(DiscretizeFirst(system, map), energies, start, 0.1, 200);
  BOOST_TEST(of_method_1 > 2e-4);
  BOOST_TEST(of_method_1 < 5e-4);
  for (const auto& kind : kinds)
    for (const double h : {0.1, 1e-3})
      BOOST_TEST(drift(DiscreteGradient(system, map, kind), energies, start, h, 2000) < 1e-13,
                 kind->name() << ", h = " << h);
}

// At rest at an equilibrium, at rest elsewhere, along one axis, and with steps that do hardly move:
// nothing is divided by zero, and no digits are lost.
BOOST_AUTO_TEST_CASE(starts_at_rest_and_along_axes) {
  const auto system = oscillator(
      [](V x, T) { return square(x[1]) * (0.5 + square(x[0])) - cos(x[0]) + exp(x[0]) - x[0]; });
  const auto map = std::make_shared<Theta>(system->manifold());
  const StepEnergies energies(system);
  for (const auto& kind : kinds) {
    const DiscreteGradient method(system, map, kind);
    const State rest = method.advance({.x = VectorXd::Zero(2)}, 0.1, 10);
    BOOST_TEST(rest.x.norm() == 0.0);
    for (const VectorXd& x : {VectorXd{{0.7, 0.0}}, VectorXd{{0.0, 0.4}}, VectorXd{{1e-9, 0.0}}})
      for (const double h : {1e-4, 1e-9, 1e-14})
        BOOST_TEST(drift(method, energies, {.x = x}, h, 50) <= 1e-14, kind->name());
    // From rest with a small step: p = -h V'(q), to all digits.
    const State moved = method.advance({.x = VectorXd{{0.7, 0.0}}}, 1e-8);
    const double force = -(std::sin(0.7) + std::exp(0.7) - 1.0);
    BOOST_TEST(std::abs(moved.x[1] / (1e-8 * force) - 1.0) < 1e-13, kind->name());
  }
}

// However long: where Newton's method contracts slowly, what it stops at is a solution all the same.
BOOST_AUTO_TEST_CASE(long_steps) {
  const auto coupled = oscillator(
      [](V x, T) { return square(x[1]) * (0.5 + square(x[0])) - cos(x[0]) + exp(x[0]) - x[0]; });
  for (const auto& [system, x] :
       {std::pair{coupled, VectorXd{{0.7, 0.0}}}, std::pair{quartic(), VectorXd{{1.0, 0.0}}}}) {
    const auto map = std::make_shared<Theta>(system->manifold());
    const StepEnergies energies(system);
    for (const auto& kind : kinds)
      for (const double h : {0.3, 0.7, 1.0, 2.0, 3.0, 5.0})
        BOOST_TEST(drift(DiscreteGradient(system, map, kind), energies, {.x = x}, h, 100) < 1e-13,
                   kind->name() << ", h = " << h);
  }
}

// Closed ports, equation (30): 0 = Bᵀα in every step, and u does no work.
BOOST_AUTO_TEST_CASE(closed_ports) {
  const auto space = std::make_shared<Euclidean>(3);
  const auto J = [](V x) {
    ExprMatrix A = ExprMatrix::Zero(3, 3);
    A(0, 2) = -1.0;
    A(2, 0) = 1.0;
    A(1, 2) = 0.3 * x[0];
    A(2, 1) = -A(1, 2);
    return A;
  };
  const auto B = [](V x) {
    ExprMatrix column(3, 1);
    column << Expr(1.0), Expr(-1.0), 0.2 * x[2];
    return column;
  };
  const auto energy = std::make_shared<Hamiltonian>(space, [](V x, T) {
    return square(x[0]) / 2.0 + square(square(x[0])) / 8.0 + square(x[1]) / 6.0 + cosh(x[2]);
  });
  const auto system = std::make_shared<PortHamiltonianSystem>(
      PortHamiltonianSystem::Matrices{J, {}, B, 1}, energy, std::nullopt);
  const StepEnergies energies(system);
  // On M_0 = {Bᵀ dH = 0}.
  const double q1 = 0.5, q2 = 3.0 * (q1 + q1 * q1 * q1 / 2.0);
  for (const auto& kind : kinds) {
    const DiscreteGradient method(system, std::make_shared<Theta>(space), kind);
    const auto stepper = method.stepper();
    State state{.x = VectorXd{{q1, q2, 0.0}}};
    const double first = energies.energy(state);
    for (int k = 0; k < 100; ++k) {
      stepper->step(state, 0.05);
      const Step& step = stepper->last();
      const VectorXd alpha = energies.effort(step);
      BOOST_TEST(std::abs(values(B(constants(step.stage.x))).col(0).dot(alpha)) < 1e-12);
      BOOST_TEST(std::abs(energies(step).supply()) < 1e-15);
      BOOST_TEST(std::abs(energies.energy(state) - first) < 1e-14);
    }
  }
}

// A bead on a rod's end: the length and the energy are kept, and the multiplier is the tension.
BOOST_AUTO_TEST_CASE(holonomic_constraints) {
  const auto plane = std::make_shared<Euclidean>(2);
  const auto M = std::make_shared<CotangentBundle>(plane);
  const auto system = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(M),
      std::make_shared<ConstrainedFamily>(
          std::make_shared<Hamiltonian>(
              M, [](V x, T) { return (square(x[2]) + square(x[3])) / 2.0 + 9.81 * x[1]; }),
          [](V x, V, T) {
            return ExprVector(ExprVector::Constant(1, (square(x[0]) + square(x[1]) - 1.0) / 2.0));
          },
          1));
  BOOST_TEST(system->has_explicit_energy());
  for (const auto& kind : kinds) {
    const DiscreteGradient method(system, std::make_shared<Theta>(M), kind);
    const auto stepper = method.stepper();
    State state{.x = VectorXd{{1.0, 0.0, 0.0, 0.0}}};  // released at rest at the horizontal
    double height = 0.0;
    for (int k = 0; k < 300; ++k) {
      stepper->step(state, 0.01);
      const VectorXd& x = state.x;
      BOOST_TEST(std::abs(x.head(2).norm() - 1.0) < 1e-13);
      BOOST_TEST(std::abs((x[2] * x[2] + x[3] * x[3]) / 2.0 + 9.81 * x[1]) < 1e-12);
      height = std::min(height, x[1]);
    }
    BOOST_TEST(height < -0.999, kind->name());
  }
}

// A charge and a flux with laws that are not linear, a source and a resistor.
BOOST_AUTO_TEST_CASE(networks) {
  using Kind = NetworkBranch::Kind;
  using Role = NetworkBranch::Role;
  const auto system = std::make_shared<Network>(
      3,
      std::vector<NetworkBranch>{
          {.name = "V",
           .from = 1,
           .to = 0,
           .role = Role::source,
           .law = [](const NetworkVariables& at) { return sin(at.t()); }},
          {.name = "R",
           .from = 1,
           .to = 2,
           .law = [](const NetworkVariables& at) { return 0.7 * at.current(1); }},
          {.name = "C", .from = 2, .to = 0, .kind = Kind::charge, .role = Role::storage},
          {.name = "L", .from = 2, .to = 0, .kind = Kind::flux, .role = Role::storage}},
      [](V x, T) { return cosh(x[0]) + square(x[1]) / 2.0 + square(square(x[1])) / 4.0; });
  const StepEnergies energies(system);
  BOOST_TEST((energies.suppliers() == std::vector<std::string>{"V"}));
  BOOST_TEST((energies.dissipators() == std::vector<std::string>{"R"}));
  for (const auto& kind : kinds) {
    const DiscreteGradient method(system, std::make_shared<Theta>(system->manifold()), kind);
    const auto stepper = method.stepper();
    State state{.x = VectorXd::Zero(2)};
    double moved = 0.0;
    for (int k = 0; k < 200; ++k) {
      const double before = energies.energy(state);
      stepper->step(state, 0.1);
      const auto [supplied, dissipated, moved_energy, at_stage] = energies(stepper->last());
      BOOST_TEST(dissipated[0] >= 0.0);
      moved += dissipated[0];
      BOOST_TEST(std::abs(energies.energy(state) - before - supplied[0] + dissipated[0]) < 3e-15);
    }
    BOOST_TEST(moved > 1.0);
  }
}

// On T*S², where the retraction is that of the map.
BOOST_AUTO_TEST_CASE(on_spheres) {
  const auto sphere = std::make_shared<Sphere>(2);
  const auto M = std::make_shared<CotangentBundle>(sphere);
  const auto system = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(M), std::make_shared<Hamiltonian>(M, [](V x, T) {
        return (square(x[3]) + square(x[4]) + square(x[5])) / 2.0 + exp(x[2]) + x[0] * x[1];
      }));
  const auto map = std::make_shared<CotangentLift>(M, std::make_shared<Chordal>(sphere));
  const StepEnergies energies(system);
  State start{.x = VectorXd::Zero(6)};
  start.x.head(3) << 0.6, 0.0, -0.8;
  start.x.tail(3) << 0.4, 0.5, 0.3;
  for (const auto& kind : kinds)
    BOOST_TEST(drift(DiscreteGradient(system, map, kind), energies, start, 0.1, 100) < 1e-13,
               kind->name());
  BOOST_TEST(drift(DiscretizeFirst(system, map), energies, start, 0.1, 100) > 1e-4);
}

BOOST_AUTO_TEST_CASE(what_has_no_energy_is_refused) {
  const auto line = std::make_shared<Euclidean>(1);
  const auto formulas = std::make_shared<examples::FormulaSystem>(
      line, 0, 1, [](V x, V v, V, T) { return ExprVector(v + x); });
  const auto M = std::make_shared<CotangentBundle>(line);
  const auto of_lagrangian = [&](Lagrangian::Formula L) {
    return std::make_shared<DiracSystem>(std::make_shared<CanonicalSymplectic>(M),
                                         std::make_shared<Lagrangian>(M, std::move(L)));
  };
  const auto lagrangian =
      of_lagrangian([](V q, V w, T) { return square(square(w[0])) / 2.0 - q[0]; });
  BOOST_TEST(!lagrangian->has_explicit_energy());
  const auto kinetic = of_lagrangian([](V q, V w, T) { return square(w[0]) / 2.0 - q[0]; });
  BOOST_CHECK_NO_THROW(DiscreteGradient(kinetic, std::make_shared<Theta>(M), kinds[0]));
  const auto map = std::make_shared<Theta>(line);
  BOOST_CHECK_THROW(DiscreteGradient(formulas, map, kinds[0]), std::invalid_argument);
  BOOST_CHECK_THROW(DiscreteGradient(lagrangian, std::make_shared<Theta>(M), kinds[0]),
                    std::invalid_argument);
  BOOST_CHECK_THROW(DiscreteGradient(quartic(), map, kinds[0]), std::invalid_argument);
  BOOST_CHECK_THROW(DiscreteGradient(quartic(), std::make_shared<Theta>(M), nullptr),
                    std::invalid_argument);
  BOOST_CHECK_THROW(DiscreteGradient(quartic(), std::make_shared<Theta>(M), kinds[0],
                                     {.units = VectorXd{{1.0, 0.0}}}),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
