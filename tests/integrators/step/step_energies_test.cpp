// The discrete power balance of steps: (29) and (31), read from the steps themselves.
#include "courant/integrators/step/step_energies.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/composition.hpp"
#include "courant/integrators/methods/constrain_first.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/integrators/step/projector.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/dirac_system.hpp"
#include "courant/structures/port_hamiltonian_system.hpp"

// Mistakes that these cases have to notice:
//  * what time changes is left out
//  * of a composition the last stage counts alone
BOOST_AUTO_TEST_SUITE(step_energies_test)

using namespace courant;

namespace {

using V = const ExprVector&;
using T = const Expr&;

ExprMatrix J(V) {
  ExprMatrix A = ExprMatrix::Zero(2, 2);
  A(0, 1) = 1.0;
  A(1, 0) = -1.0;
  return A;
}
ExprMatrix R(V x) {
  ExprMatrix A = ExprMatrix::Zero(2, 2);
  A(1, 1) = 0.4 + square(x[0]);
  return A;
}
ExprMatrix B(V x) {
  ExprMatrix columns(2, 2);
  columns << Expr(0.2), Expr(0.0), 1.0 + x[0], Expr(0.5);
  return columns;
}
ExprMatrix D(V) {
  ExprMatrix A = ExprMatrix::Zero(2, 2);
  A(0, 0) = 0.3;
  return A;
}

// Two ports, "motor" with feedback and "1", and H as given.
std::shared_ptr<const PortHamiltonianSystem> open(Hamiltonian::Formula H) {
  return std::make_shared<PortHamiltonianSystem>(
      PortHamiltonianSystem::Matrices{J, R, B, 2, D},
      std::make_shared<Hamiltonian>(std::make_shared<Euclidean>(2), std::move(H)),
      [](T t, V y) {
        ExprVector u(2);
        u << sin(t) - 2.0 * y[0], cos(3.0 * t);
        return u;
      },
      ImplicitSystem::Names{.auxiliary = {"u_motor", "u[1]"}});
}

// h ⟨α, v⟩ - supplied + dissipated, and H(x₁) - H(x₀) less the same.
struct Balance {
  Balance(const StepEnergies& energies, const Step& step) {
    const auto [supplied, dissipated, moved_energy, at_stage] = energies(step);
    const double ports = supplied.sum() - dissipated.sum();
    const bool has_time = !energies.suppliers().empty() && energies.suppliers().back() == "time";
    of_efforts = step.h * energies.effort(step).dot(step.stage.v) - ports +
                 (has_time ? supplied[supplied.size() - 1] : 0.0);
    // Of a step that is made of several, the efforts are those of the last part alone.
    if (step.parts.empty()) BOOST_TEST(std::abs(at_stage - of_efforts) <= 1e-13 * moved_energy);
    of_energy = energies.energy(step.after) - energies.energy(step.before) - ports;
  }
  double of_efforts, of_energy;
};

}  // namespace

// By hand at the middle of a step: y and u of each port, dHᵀ R dH, uᵀ D u.
BOOST_AUTO_TEST_CASE(powers_by_port) {
  const auto system = open([](V x, T) { return square(x[0]) + square(x[1]) / 2.0; });
  const StepEnergies energies(system);
  BOOST_TEST((energies.suppliers() == std::vector<std::string>{"motor", "1"}));
  BOOST_TEST((energies.dissipators() == std::vector<std::string>{"resistance", "feedthrough"}));
  const DiscretizeFirst method(system, std::make_shared<Theta>(system->manifold()));
  const auto stepper = method.stepper();
  State state{.t = 0.3, .x = VectorXd{{0.4, -0.6}}};
  const double h = 0.1;
  stepper->step(state, h);
  const Step& step = stepper->last();
  const VectorXd x = (step.before.x + step.after.x) / 2.0, u = step.after.z;
  BOOST_TEST((step.stage.x - x).norm() < 1e-15);
  const double y0 = 0.2 * 2.0 * x[0] + (1.0 + x[0]) * x[1] + 0.3 * u[0], y1 = 0.5 * x[1];
  BOOST_TEST(std::abs(u[0] - (std::sin(0.35) - 2.0 * y0)) < 1e-14);
  const auto [supplied, dissipated, moved_energy, at_stage] = energies(step);
  BOOST_TEST(std::abs(supplied[0] - h * y0 * u[0]) < 1e-15);
  BOOST_TEST(std::abs(supplied[1] - h * y1 * u[1]) < 1e-15);
  BOOST_TEST(std::abs(dissipated[0] - h * (0.4 + x[0] * x[0]) * x[1] * x[1]) < 1e-15);
  BOOST_TEST(std::abs(dissipated[1] - h * 0.3 * u[0] * u[0]) < 1e-15);
  BOOST_TEST((energies.effort(step) - VectorXd{{2.0 * x[0], x[1]}}).norm() < 1e-15);
}

// Of a quadratic H the midpoint map balances the energy; of others it balances ⟨dH, R_d⁻¹⟩ alone.
BOOST_AUTO_TEST_CASE(method_1) {
  for (const bool quadratic : {true, false}) {
    const auto system = open([=](V x, T t) {
      const Expr H = square(x[0]) + square(x[1]) / 2.0 + 0.3 * cos(2.0 * t) * x[0] * x[1];
      return quadratic ? H : H + square(square(x[0])) / 4.0;
    });
    const StepEnergies energies(system);
    BOOST_TEST(energies.suppliers().back() == "time");
    const DiscretizeFirst method(system, std::make_shared<Theta>(system->manifold()));
    const auto stepper = method.stepper();
    State state{.t = 0.3, .x = VectorXd{{0.4, -0.6}}};
    double worst = 0.0, time = 0.0;
    for (int k = 0; k < 50; ++k) {
      stepper->step(state, 0.1);
      const Balance balance(energies, stepper->last());
      BOOST_TEST(std::abs(balance.of_efforts) < 1e-14);
      worst = std::max(worst, std::abs(balance.of_energy));
      time = std::max(time, std::abs(energies(stepper->last()).supplied[2]));
    }
    BOOST_TEST(time > 1e-3);
    if (quadratic)
      BOOST_TEST(worst < 1e-14);
    else
      BOOST_TEST(worst > 1e-7);
  }
}

// What a composition supplies is what its stages do.
BOOST_AUTO_TEST_CASE(compositions) {
  const auto system = open([](V x, T t) {
    return square(x[0]) + square(x[1]) / 2.0 + 0.3 * cos(2.0 * t) * x[0] * x[1];
  });
  const StepEnergies energies(system);
  const Composition method(
      std::make_shared<DiscretizeFirst>(system, std::make_shared<Theta>(system->manifold())), 4);
  const auto stepper = method.stepper();
  State state{.t = 0.3, .x = VectorXd{{0.4, -0.6}}};
  stepper->step(state, 0.1);
  BOOST_CHECK_THROW(energies(stepper->last()), std::invalid_argument);
  stepper->tell_parts();
  for (int k = 0; k < 20; ++k) {
    stepper->step(state, 0.1);
    BOOST_TEST(stepper->last().parts.size() == 5u);
    BOOST_TEST(std::abs(Balance(energies, stepper->last()).of_energy) < 1e-14);
    BOOST_TEST(std::abs(Balance(energies, stepper->part(0.3)).of_energy) < 1e-14);
  }
  // A step that cannot be made changes nothing in what is known of the last one.
  const double supply = energies(stepper->last()).supply();
  BOOST_CHECK_THROW(stepper->step(state, std::nan("")), std::invalid_argument);
  BOOST_TEST(energies(stepper->last()).supply() == supply);
}

// Closed ports supply nothing, and Method 2 keeps to M_0 at both ends and at the stage.
BOOST_AUTO_TEST_CASE(method_2_of_closed_ports) {
  const auto space = std::make_shared<Euclidean>(3);
  const auto system = std::make_shared<PortHamiltonianSystem>(
      PortHamiltonianSystem::Matrices{[](V) {
                                        ExprMatrix A = ExprMatrix::Zero(3, 3);
                                        A(0, 2) = -1.0;
                                        A(2, 0) = 1.0;
                                        return A;
                                      },
                                      [](V) {
                                        ExprMatrix A = ExprMatrix::Zero(3, 3);
                                        A(2, 2) = 0.2;
                                        return A;
                                      },
                                      [](V) {
                                        ExprMatrix column(3, 1);
                                        column << Expr(1.0), Expr(-1.0), Expr(0.0);
                                        return column;
                                      },
                                      1},
      std::make_shared<Hamiltonian>(
          space, [](V x, T) { return square(x[0]) / 2.0 + square(x[1]) / 6.0 + square(x[2]); }),
      std::nullopt);
  const auto ladder =
      ConstraintAlgorithm().run(system, InitialGuess{.x = VectorXd{{1.0, 3.0, 0.2}}});
  const ConstrainFirst method(system, ladder, std::make_shared<Theta>(space),
                              std::make_shared<OrthogonalProjector>());
  const StepEnergies energies(system);
  const auto stepper = method.stepper();
  State state = ladder.point;
  double loss = 0.0;
  for (int k = 0; k < 50; ++k) {
    stepper->step(state, 0.1);
    const Balance balance(energies, stepper->last());
    const auto [supplied, dissipated, moved_energy, at_stage] = energies(stepper->last());
    BOOST_TEST(std::abs(balance.of_efforts) < 1e-14);
    BOOST_TEST(std::abs(balance.of_energy) < 1e-14);
    BOOST_TEST(std::abs(supplied[0]) < 1e-14);
    BOOST_TEST(dissipated[0] >= 0.0);
    loss += dissipated[0];
  }
  BOOST_TEST(loss > 0.1);
}

// What forces give a mechanical system is ⟨F, v⟩, what a moving constraint gives is not zero.
BOOST_AUTO_TEST_CASE(forces_and_moving_constraints) {
  const auto M = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(2));
  const DiracSystem::Exterior exterior{
      .source =
          [](V, V v, V, T) {
            ExprVector e = ExprVector::Zero(8);
            e[4] = -0.3 * v[0];
            e[5] = 2.0;
            return e;
          },
      .constraint = [](V, V v, V,
                       T t) { return ExprVector(ExprVector::Constant(1, v[0] - v[1] - cos(t))); },
      .constraint_count = 1};
  const auto system = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(M),
      std::make_shared<Hamiltonian>(M, [](V x, T) { return x.squaredNorm() / 2.0; }), exterior);
  const StepEnergies energies(system);
  BOOST_TEST((energies.suppliers() == std::vector<std::string>{"forces", "constraints"}));
  const DiscretizeFirst method(system, std::make_shared<Theta>(M));
  const auto stepper = method.stepper();
  State state{.x = VectorXd{{0.4, -0.6, 0.7, -0.3}}};
  for (int k = 0; k < 20; ++k) {
    stepper->step(state, 0.1);
    const Step& step = stepper->last();
    const auto [supplied, dissipated, moved_energy, at_stage] = energies(step);
    const VectorXd& v = step.stage.v;
    BOOST_TEST(std::abs(supplied[0] - 0.1 * (-0.3 * v[0] * v[0] + 2.0 * v[1])) < 1e-14);
    BOOST_TEST(std::abs(std::abs(supplied[1]) -
                        0.1 * std::abs(step.stage.z[0] * std::cos(step.stage.t))) < 1e-14);
    const Balance balance(energies, step);
    BOOST_TEST(std::abs(balance.of_efforts) < 1e-13);
    BOOST_TEST(std::abs(balance.of_energy) < 1e-13);
  }
}

BOOST_AUTO_TEST_SUITE_END()
