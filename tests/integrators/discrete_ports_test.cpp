// Steps of port-Hamiltonian systems are elements of their discrete structures (Section 7.1).
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/integrators/maps/discrete_dirac_structure.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/closed_port_hamiltonian.hpp"
#include "courant/structures/open_port_hamiltonian.hpp"
#include "courant/structures/port_hamiltonian_system.hpp"

// Mistakes that these cases have to notice:
//  * distances forget the time step (integrators/maps/discrete_dirac_structure.cpp)
BOOST_AUTO_TEST_SUITE(discrete_ports)

using namespace courant;

namespace {

constexpr double tolerance = 1e-12;

// On R², H = p²/2 + q²/2 + q⁴/4 + q p/3 with a port that depends on the point, and the midpoint
// map.
struct Ports {
  static ExprMatrix J(const ExprVector&) {
    ExprMatrix matrix = ExprMatrix::Zero(2, 2);
    matrix(0, 1) = 1.0;
    matrix(1, 0) = -1.0;
    return matrix;
  }
  static ExprMatrix B(const ExprVector& x) {
    ExprMatrix column(2, 1);
    column << Expr(0.2), 1.0 + x[0];
    return column;
  }
  VectorXd differential(const VectorXd& x) const {
    return values(energy->differential(constants(x), ExprVector(0), 0.0));
  }
  double H(const VectorXd& x) const {
    return energy->value(constants(x), ExprVector(0), 0.0).value();
  }
  std::shared_ptr<const Manifold> M = std::make_shared<Euclidean>(2);
  std::shared_ptr<const DiscretizationMap> map = std::make_shared<Theta>(M, 0.5);
  std::shared_ptr<const Hamiltonian> energy =
      std::make_shared<Hamiltonian>(M, [](const ExprVector& x, const Expr&) {
        return square(x[1]) / 2.0 + square(x[0]) / 2.0 + square(square(x[0])) / 4.0 +
               x[0] * x[1] / 3.0;
      });
};

}  // namespace

// Equations (28) and (29): a step of the open system is a pair of points with dH at the base point
// in the discrete structure, and h⟨y, u⟩ = ⟨dH, R_d⁻¹(x₀, x₁)⟩, which is not H(x₁) - H(x₀).
BOOST_AUTO_TEST_CASE(open_ports) {
  const Ports ports;
  const auto structure = std::make_shared<OpenPortHamiltonian>(ports.M, Ports::J, 1, Ports::B);
  const DiscreteDiracStructure discrete(structure, ports.map);
  const double h = 0.1, t0 = 0.4;
  const auto input = [](const Expr& t, const ExprVector& y) {
    return ExprVector(ExprVector::Constant(1, 0.5 + sin(t) - 2.0 * y[0]));
  };
  const PortHamiltonianSystem::Matrices matrices{Ports::J, {}, Ports::B, 1};
  const auto system = std::make_shared<PortHamiltonianSystem>(matrices, ports.energy, input);
  const auto stepper = DiscretizeFirst(system, ports.map).stepper();
  State state{.t = t0, .x = VectorXd{{0.4, -0.6}}};
  double apart = 0.0;
  for (int k = 0; k < 4; ++k) {
    const VectorXd x0 = state.x;
    stepper->step(state, h);
    const VectorXd x1 = state.x;
    const auto [x, v] = ports.map->inverse(x0, x1);
    const VectorXd dH = ports.differential(x);
    BOOST_TEST(discrete.distance(x0, x1, dH, h) < tolerance);
    BOOST_TEST(discrete.distance(x0, x1, 1.1 * dH, h) > 1e-3);
    const VectorXd y = values(structure->output(constants(x), constants(dH)));
    const double u = 0.5 + std::sin(t0 + (k + 0.5) * h) - 2.0 * y[0];
    BOOST_TEST(state.z[0] == u, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(std::abs(h * y[0] * u - dH.dot(v)) < 1e-14);
    BOOST_TEST(std::abs(h * y[0] * u) > 1e-3);
    apart = std::max(apart, std::abs(ports.H(x1) - ports.H(x0) - dH.dot(v)));
  }
  BOOST_TEST(apart > 1e-8);
}

// Equations (30) and (31): with closed ports y = 0 at the base point, and ⟨dH, R_d⁻¹⟩ = 0.
BOOST_AUTO_TEST_CASE(closed_ports) {
  const Ports ports;
  const auto structure = std::make_shared<ClosedPortHamiltonian>(ports.M, Ports::J, 1, Ports::B);
  const OpenPortHamiltonian open(ports.M, Ports::J, 1, Ports::B);
  const DiscreteDiracStructure discrete(structure, ports.map);
  const auto system = std::make_shared<PortHamiltonianSystem>(
      PortHamiltonianSystem::Matrices{Ports::J, {}, Ports::B, 1}, ports.energy, std::nullopt);
  const double h = 0.1;
  const auto stepper = DiscretizeFirst(system, ports.map).stepper();
  State state{.x = VectorXd{{0.4, -0.6}}};
  for (int k = 0; k < 4; ++k) {
    const VectorXd x0 = state.x;
    stepper->step(state, h);
    const VectorXd x1 = state.x;
    const auto [x, v] = ports.map->inverse(x0, x1);
    const VectorXd dH = ports.differential(x);
    BOOST_TEST(discrete.distance(x0, x1, dH, h) < tolerance);
    BOOST_TEST(values(open.output(constants(x), constants(dH))).norm() < 1e-13);
    BOOST_TEST(std::abs(dH.dot(v)) < 1e-13);
    BOOST_TEST(v.norm() > 1e-2);
  }
}

BOOST_AUTO_TEST_SUITE_END()
