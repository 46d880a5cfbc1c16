#include "courant/integrators/ladder/constraint_algorithm.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "ladder_catalogue.hpp"

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

BOOST_AUTO_TEST_SUITE(constraint_algorithm_test)

// Section 6.1: M_0 = Im α, S_1 is the graph of the vector field (6) on it.
BOOST_AUTO_TEST_CASE(four_vortices) {
  const ConstraintLadder ladder = ConstraintAlgorithm().run(vortices(), vortex_guess());
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
BOOST_AUTO_TEST_CASE(remark_7_2) {
  const ConstraintLadder ladder = known("closed port-Hamiltonian system").problem.ladder();
  BOOST_TEST(ladder.levels[0].fibre() == 1);
  BOOST_TEST(ladder.levels[1].fibre() == 0);
  BOOST_TEST(ladder.index == 1);
}

// 7.2: x_3 + x_1 = 0 and its derivative (u - 2 x_1) + (x_3 + u/2) = 0.
BOOST_AUTO_TEST_CASE(closed_port_hamiltonian) {
  const ConstraintLadder ladder = known("closed port-Hamiltonian system").problem.ladder();
  const VectorXd& x = ladder.point.x;
  BOOST_TEST(std::abs(x[3] + x[1]) < 1e-14);
  BOOST_TEST(ladder.point.z[0] == (2 * x[1] - x[3]) / 1.5, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(ladder.determined[0]);
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
      const ConstraintLadder ladder = ConstraintAlgorithm().run(system, guess);
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
  const ConstraintLadder ladder =
      ConstraintAlgorithm({.max_level = 3}).run(problem.system, problem.guess);
  BOOST_TEST(to_string(ladder.verdict) == "not-reached");
  BOOST_TEST(ladder.index == -1);
  BOOST_TEST((dimensions(ladder) == Dimensions{{5, 4}, {4, 3}, {3, 2}, {2, 1}}));
}

BOOST_AUTO_TEST_SUITE_END()
