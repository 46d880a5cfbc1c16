#include "courant/integrators/certificate/constraint_algorithm.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/constrain_first.hpp"
#include "courant/integrators/step/vector_field.hpp"
#include "courant/structures/dirac_system.hpp"
#include "courant/structures/port_hamiltonian_system.hpp"
#include "ladder_catalogue.hpp"

BOOST_AUTO_TEST_SUITE(constraint_algorithm_test)

using namespace courant;
using namespace courant::examples;

namespace {

KnownLadder known(const std::string& name) {
  for (const KnownLadder& entry : catalogue())
    if (entry.name == name) return entry;
  throw std::invalid_argument(name);
}

// As it is, and in other orders, units and coordinates.
void check_table(const std::string& name) {
  const KnownLadder entry = known(name);
  std::mt19937 generator(7);
  const auto check = [&](const char* how, const Problem& problem) {
    const ConstraintLadder ladder = problem.ladder();
    BOOST_TEST_CONTEXT(name << how << ": " << ladder.reason) {
      BOOST_TEST((dimensions(ladder) == entry.dimensions));
      BOOST_TEST(to_string(ladder.verdict) == to_string(entry.verdict));
      BOOST_TEST(ladder.index == entry.index);
    }
  };
  check("", entry.problem);
  for (int trial = 0; trial < 5; ++trial) {
    check(", permuted", permuted(entry.problem, generator));
    check(", scaled", scaled(entry.problem, generator));
    check(", transformed", transformed(entry.problem, generator));
  }
}

}  // namespace

// Section 6.1: M_0 = Im α, S_1 is the graph of the vector field (6) on it.
BOOST_AUTO_TEST_CASE(four_vortices) {
  const ConstraintLadder ladder = certificate(vortices(), vortex_guess());
  BOOST_TEST((dimensions(ladder) == Dimensions{{16, 8}, {8, 8}, {8, 8}}));
  BOOST_TEST(to_string(ladder.verdict) == "regular");
  BOOST_TEST(ladder.index == 1);
  BOOST_TEST(ladder.degrees_of_freedom == 8);
  BOOST_TEST(ladder.moved > 0.0);
  // Eight of the 24 equations are differentiated, once: p = α(q).
  std::vector<int> expected(24, 0);
  std::fill(expected.begin() + 16, expected.end(), 1);
  BOOST_TEST(ladder.differentiations == expected, boost::test_tools::per_element());
  BOOST_TEST(ladder.constraints.size() == 8U);
  check_table("four vortices");
  // The energy is that of (9), and q' on S_1 is that of (6), dα(q') = -dH.
  const double strength[] = {1, 1, -1, -1};
  InitialGuess guess = vortex_guess();
  for (Index i = 0; i < 4; ++i) {
    guess.x[8 + i] = -0.5 * strength[i] * guess.x[4 + i];
    guess.x[12 + i] = 0.5 * strength[i] * guess.x[i];
  }
  const ConstraintLadder on_M0 = certificate(vortices(), guess);
  BOOST_TEST(on_M0.moved < 1e-14);
  const VectorXd& x = on_M0.point.x;
  const auto energy = vortices()->energy(constants(x), constants(on_M0.point.z), 0.0);
  BOOST_TEST(energy->value() == -0.697421199668691, boost::test_tools::tolerance(1e-13));
  for (Index i = 0; i < 4; ++i) {
    double dx = 0.0, dy = 0.0;
    for (Index j = 0; j < 4; ++j) {
      if (i == j) continue;
      const double a = x[i] - x[j], b = x[4 + i] - x[4 + j];
      dx -= strength[j] * b / (2.0 * std::numbers::pi * (a * a + b * b));
      dy += strength[j] * a / (2.0 * std::numbers::pi * (a * a + b * b));
    }
    BOOST_TEST(on_M0.point.v[i] == dx, boost::test_tools::tolerance(1e-11));
    BOOST_TEST(on_M0.point.v[4 + i] == dy, boost::test_tools::tolerance(1e-11));
  }
}

BOOST_AUTO_TEST_CASE(cartesian_pendulum) { check_table("Cartesian pendulum"); }
BOOST_AUTO_TEST_CASE(nonholonomic_particle) { check_table("nonholonomic particle"); }
BOOST_AUTO_TEST_CASE(parallel_capacitors) { check_table("parallel capacitors"); }
BOOST_AUTO_TEST_CASE(christ_lee) { check_table("Christ-Lee"); }

// L = q' + q has p = 1 and p' = 1: S_1 is empty, and the equations to blame are named.
BOOST_AUTO_TEST_CASE(inconsistent_lagrangian) {
  const ConstraintLadder ladder = known("L = q' + q").problem.ladder();
  BOOST_TEST(to_string(ladder.verdict) == "inconsistent");
  BOOST_TEST((dimensions(ladder) == Dimensions{{2, 1}, {-1, -1}}));
  BOOST_TEST(ladder.levels[1].is_empty);
  BOOST_TEST(ladder.levels[1].residual > 0.1);
  BOOST_TEST(ladder.reason.find("equation[1]") != std::string::npos, ladder.reason);
}

// Section 8.2: λ = (p_x p_y - x y) / (1 + y²) for V = (x² + y²)/2 and z' = y x'.
BOOST_AUTO_TEST_CASE(nonholonomic_multipliers) {
  const ConstraintLadder ladder = known("nonholonomic particle").problem.ladder();
  const VectorXd& x = ladder.point.x;
  BOOST_TEST(ladder.determined[0]);
  BOOST_TEST(ladder.point.z[0] == (x[3] * x[4] - x[0] * x[1]) / (1 + x[1] * x[1]),
             boost::test_tools::tolerance(1e-12));
}

// A closed system is an implicit one: Bᵀ∇H = 0 constrains x, and u follows from its derivative.
// The same ladder from the Dirac structure (27) and from the system of (26).
BOOST_AUTO_TEST_CASE(remark_7_2) {
  check_table("closed port-Hamiltonian system");
  const KnownLadder entry = known("closed port-Hamiltonian system");
  const auto dirac = std::dynamic_pointer_cast<const DiracSystem>(entry.problem.system);
  BOOST_REQUIRE(dirac);
  const ExprMatrix column = (ExprMatrix(4, 1) << 0.0, 0.5, 0.0, 1.0).finished();
  const ExprMatrix J =
      constants(MatrixXd{{0, 0, 1, 0}, {0, 0, 0, 1}, {-1, 0, 0, 0}, {0, -1, 0, 0}});
  const auto system = std::make_shared<PortHamiltonianSystem>(
      PortHamiltonianSystem::Matrices{.J = [J](const ExprVector&) { return J; },
                                      .R = {},
                                      .B = [column](const ExprVector&) { return column; },
                                      .m = 1},
      dirac->family(), std::nullopt);
  const ConstraintLadder of_system = Problem{system, entry.problem.guess}.ladder();
  const ConstraintLadder ladder = entry.problem.ladder();
  BOOST_TEST((dimensions(of_system) == dimensions(ladder)));
  BOOST_TEST((of_system.point.x - ladder.point.x).norm() < 1e-12);
  BOOST_TEST((of_system.point.v - ladder.point.v).norm() < 1e-12);
  BOOST_TEST((of_system.point.z - ladder.point.z).norm() < 1e-12);
  BOOST_TEST(ladder.levels[0].fibre() == 1);
  BOOST_TEST(ladder.levels[1].fibre() == 0);
  BOOST_TEST(ladder.index == 1);
}

// 7.2: S_0 is given by (27), M_0 by Bᵀ∇H = x_3 + x_1 = 0, and S_1 by its derivative besides, (u - 2
// x_1) + (x_3 + u/2) = 0: all of them at the point that was found.
BOOST_AUTO_TEST_CASE(closed_port_hamiltonian) {
  const ConstraintLadder ladder = known("closed port-Hamiltonian system").problem.ladder();
  const VectorXd& x = ladder.point.x;
  BOOST_TEST(std::abs(x[3] + x[1]) < 1e-14);
  BOOST_TEST(ladder.point.z[0] == (2 * x[1] - x[3]) / 1.5, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(ladder.determined[0]);
  const double u = ladder.point.z[0];
  VectorXd v(4);
  v << x[2], x[3] + 0.5 * u, -x[0] - x[0] * x[0] * x[0], -2.0 * x[1] + u;
  BOOST_TEST((ladder.point.v - v).norm() < 1e-12);
  // T M_0 is the kernel of dx_3 + dx_1, which the equations say themselves: no hidden constraint.
  BOOST_REQUIRE_EQUAL(ladder.constraints.size(), 1U);
  BOOST_TEST(ladder.constraints[0].level == 0);
  const VectorXd gradient = ladder.constraints[0].gradient;
  BOOST_TEST((gradient / gradient[1] - VectorXd{{0.0, 1.0, 0.0, 1.0}}).norm() < 1e-12);
  BOOST_TEST((dimensions(ladder) == Dimensions{{4, 3}, {3, 3}, {3, 3}}));
}

// x' = y, y' = z, x = t²: z = 2 is seen in the second derivative of the last equation, less the
// first of the first and the second itself. Coefficients are of dⁱF/dtⁱ, without a factorial.
BOOST_AUTO_TEST_CASE(constraints_say_where_they_come_from) {
  const auto system =
      flat(3, 0, 3, [](const ExprVector& x, const ExprVector& v, const ExprVector&, const Expr& t) {
        return equations({v[0] - x[1], v[1] - x[2], x[0] - square(t)});
      });
  const ConstraintLadder ladder = certificate(system, {.t = 0.7, .x = VectorXd{{0.49, 1.4, 2.0}}});
  BOOST_REQUIRE_EQUAL(ladder.constraints.size(), 3U);
  for (const PointConstraint& constraint : ladder.constraints) {
    double coefficient[3][3] = {};
    for (const Combination::Term& term : constraint.origin.terms)
      coefficient[term.equation][term.derivative] = term.coefficient;
    const Index seen = constraint.level;  // x, y, z
    VectorXd expected = VectorXd::Zero(3);
    expected[seen] = 1.0;
    const VectorXd gradient = constraint.gradient;
    BOOST_TEST((gradient / gradient[seen] - expected).norm() < 1e-12);
    const double scale = coefficient[2][seen];
    BOOST_REQUIRE(std::abs(scale) > 1e-6);
    if (seen == 1)
      BOOST_TEST(coefficient[0][0] / scale == -1.0, boost::test_tools::tolerance(1e-9));
    if (seen == 2) {
      BOOST_TEST(coefficient[0][1] / scale == -1.0, boost::test_tools::tolerance(1e-9));
      BOOST_TEST(coefficient[1][0] / scale == -1.0, boost::test_tools::tolerance(1e-9));
    }
  }
}

// Two equations contradict each other, and the third has nothing to do with it.
BOOST_AUTO_TEST_CASE(the_equations_that_contradict_each_other_are_named) {
  const auto system =
      flat(2, 0, 3,
           [](const ExprVector& x, const ExprVector& v, const ExprVector&, const Expr&) {
             return equations({x[0] - 1.0, v[1] - 1.0, 2.0 * x[0] - 4.0});
           },
           {{"x", "y"}, {}, {"first", "bystander", "third"}});
  const ConstraintLadder ladder = certificate(system, at({1.3, 0.2}));
  BOOST_TEST(to_string(ladder.verdict) == "inconsistent");
  BOOST_TEST(ladder.reason.find("first") != std::string::npos, ladder.reason);
  BOOST_TEST(ladder.reason.find("third") != std::string::npos, ladder.reason);
  BOOST_TEST(ladder.reason.find("bystander") == std::string::npos, ladder.reason);
  BOOST_TEST_REQUIRE(ladder.contradiction.size() == 2u);
  BOOST_TEST(ladder.contradiction[0].name == "first");
  BOOST_TEST(ladder.contradiction[1].name == "third");
  BOOST_TEST(ladder.contradiction[1].derivative == 0);
}

// x'² = x with z = x': two velocities at each point. The velocity and the unknown of the last point
// are a warm start that stays on its branch, here twenty times from x = 1 to x = 11.
BOOST_AUTO_TEST_CASE(a_warm_start_stays_on_its_branch) {
  const auto system =
      flat(1, 1, 2, [](const ExprVector& x, const ExprVector& v, const ExprVector& z, const Expr&) {
        ExprVector F(2);
        F << z[0] - v[0], z[0] * z[0] - x[0];
        return F;
      });
  for (const double sign : {1.0, -1.0}) {
    InitialGuess guess = at({1.0});
    guess.v = guess.z = VectorXd::Constant(1, 0.8 * sign);
    for (int k = 0; k <= 20; ++k) {
      const ConstraintLadder ladder = certificate(system, guess);
      const double x = 1.0 + 0.5 * k;
      BOOST_TEST(ladder.point.x[0] == x);
      BOOST_TEST(ladder.point.v[0] == sign * std::sqrt(x), boost::test_tools::tolerance(1e-12));
      guess.v = ladder.point.v;
      guess.z = ladder.point.z;
      guess.x[0] = x + 0.5;
    }
  }
}

BOOST_AUTO_TEST_CASE(levels_that_are_not_allowed_are_not_reached) {
  const Problem problem = known("prescribed trajectory of a chain of five").problem;
  const ConstraintLadder ladder = certificate(problem.system, problem.guess, {.max_level = 3});
  BOOST_TEST(to_string(ladder.verdict) == "not-reached");
  BOOST_TEST(ladder.index == -1);
  BOOST_TEST((dimensions(ladder) == Dimensions{{5, 4}, {4, 3}, {3, 2}, {2, 1}}));
}

BOOST_AUTO_TEST_CASE(starts_without_meaning_are_refused) {
  BOOST_CHECK_THROW(certificate(nullptr, vortex_guess()), std::invalid_argument);
  const double nan = std::nan("");
  InitialGuess guess = vortex_guess();
  guess.x[3] = nan;
  BOOST_CHECK_THROW(certificate(vortices(), guess), std::invalid_argument);
  guess = vortex_guess();
  guess.v = VectorXd::Constant(16, nan);
  BOOST_CHECK_THROW(certificate(vortices(), guess), std::invalid_argument);
  guess = vortex_guess();
  guess.t = std::numeric_limits<double>::infinity();
  BOOST_CHECK_THROW(certificate(vortices(), guess), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(ladders_of_other_systems_are_refused) {
  const ConstraintLadder ladder = certificate(vortices(), vortex_guess());
  BOOST_CHECK_NO_THROW(check_ladder("here", *vortices(), ladder));
  const KnownLadder other = known("Cartesian pendulum");
  const auto system = other.problem.system;
  BOOST_CHECK_THROW(check_ladder("here", *system, ladder), std::invalid_argument);
  BOOST_CHECK_THROW(check_ladder("here", *system, ConstraintLadder()), std::invalid_argument);
  BOOST_CHECK_THROW(VectorField(system, ladder, Backend::interpreter), std::invalid_argument);
  BOOST_CHECK_THROW(VectorField(nullptr, ladder, Backend::interpreter), std::invalid_argument);
  const auto map = std::make_shared<Theta>(system->manifold());
  const auto projector = std::make_shared<OrthogonalProjector>();
  BOOST_CHECK_THROW(ConstrainFirst(system, ladder, map, projector), std::invalid_argument);
  BOOST_CHECK_THROW(ConstrainFirst(nullptr, ladder, map, projector), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
