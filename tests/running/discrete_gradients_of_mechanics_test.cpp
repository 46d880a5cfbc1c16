// Discrete gradients of systems that are given by a kinetic and a potential energy.
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>

#include "problems.hpp"
#include "run_in.hpp"

// Mistakes that these cases have to notice:
//  * the energy has the velocities of the stage (structures/explicit_energy.cpp)
//  * of a full matrix of masses the diagonal counts (structures/explicit_energy.cpp)
//  * velocities that an energy is not quadratic in count as if it were (structures/explicit_energy.cpp)
BOOST_AUTO_TEST_SUITE(discrete_gradients_of_mechanics)

using namespace courant;
using test::Problem;

namespace {

Json system_of(const char* type, const Json& coordinates, const Json& rest, const Json& initial) {
  Json system = rest;
  system["type"] = type;
  system["coordinates"] = coordinates;
  return {{"system", system}, {"initial", initial}};
}

// The greatest |H - H(0)| of a run, and where it ends.
struct Drift {
  double energy = 0.0;
  VectorXd end;
};
Drift drift(const Problem& problem, const Json& method, double h, long steps,
            const std::function<double(const VectorXd&)>& H) {
  const PreparedMethod prepared = problem.prepare(method, h);
  const auto stepper = prepared.integrator->stepper();
  State state = prepared.initial;
  const double first = H(state.x);
  Drift result;
  for (long k = 0; k < steps; ++k) {
    stepper->step(state, h);
    result.energy = std::max(result.energy, std::abs(H(state.x) - first));
  }
  result.end = state.x;
  return result;
}

}  // namespace

// Two rods of length 1 with unit masses at their ends: g = (2, c; c, 1) with c = cos(a - b).
BOOST_AUTO_TEST_CASE(a_double_pendulum_steps_as_with_its_hamiltonian) {
  const Json initial = {{"a", 1.1}, {"b", -0.4}, {"p_a", 0.3}, {"p_b", 0.2}};
  const Problem by_metric = test::problem(system_of(
      "mechanical", {"a", "b"},
      {{"metric", {{2, "cos(a-b)"}, {"cos(a-b)", 1}}}, {"potential", "-9.81*(2*cos(a)+cos(b))"}},
      initial));
  const Problem by_energy = test::problem(
      system_of("hamiltonian", {"a", "b"},
                {{"hamiltonian",
                  "(p_a^2+2*p_b^2-2*p_a*p_b*cos(a-b))/(2*(2-cos(a-b)^2))-9.81*(2*cos(a)+cos(b))"}},
                initial));
  const auto H = [](const VectorXd& x) {
    const double c = std::cos(x[0] - x[1]);
    return (x[2] * x[2] + 2.0 * x[3] * x[3] - 2.0 * x[2] * x[3] * c) / (2.0 * (2.0 - c * c)) -
           9.81 * (2.0 * std::cos(x[0]) + std::cos(x[1]));
  };
  for (const char* gradient : {"gonzalez", "averaged-vector-field", "itoh-abe"}) {
    const Json method = {{"type", "discrete-gradient"}, {"gradient", gradient}};
    const Drift metric = drift(by_metric, method, 0.02, 100, H),
                energy = drift(by_energy, method, 0.02, 100, H);
    BOOST_TEST(metric.energy < 1e-11, gradient << ": " << metric.energy);
    BOOST_TEST((metric.end - energy.end).norm() < 1e-8, gradient);
  }
  // Method 1 does not keep H.
  BOOST_TEST(drift(by_metric, "discretize-first", 0.02, 100, H).energy > 1e-4);
}

// A bob on a rod, by its constraint: both hold where steps end.
BOOST_AUTO_TEST_CASE(constraints_hold_besides) {
  const Problem pendulum = test::problem(system_of(
      "mechanical", {"x", "y"},
      {{"metric", {0.7, 0.7}}, {"potential", "0.7*9.81*y"}, {"holonomic", "x^2 + y^2 - 1"}},
      {{"x", 0.6}, {"y", -0.8}, {"p_x", 0.8}, {"p_y", 0.6}}));
  double off = 0.0;
  const auto H = [&](const VectorXd& x) {
    off = std::max(off, std::abs(x.head(2).squaredNorm() - 1.0));
    return x.tail(2).squaredNorm() / 1.4 + 0.7 * 9.81 * x[1];
  };
  BOOST_TEST(drift(pendulum, "discrete-gradient", 0.05, 200, H).energy < 1e-11);
  BOOST_TEST(off < 1e-11);
}

// What dampers and motors take and give is all that changes H; on a group as well.
BOOST_AUTO_TEST_CASE(the_balance_is_exact) {
  const auto balance = [](Json experiment) {
    experiment["method"] = "discrete-gradient";
    experiment["time"] = {{"step", 0.05}, {"end", 5}};
    const TemporaryFolder folder;
    const RunOutcome outcome = run_in(folder, experiment);
    BOOST_TEST((outcome.status == RunStatus::completed), outcome.message);
    const QuantityRecord* H = outcome.summary.observable("H");
    const QuantityRecord* left = outcome.summary.observable("balance");
    BOOST_TEST_REQUIRE(H != nullptr);
    BOOST_TEST_REQUIRE(left != nullptr);
    BOOST_TEST(H->max - H->min > 0.01);
    return std::max(std::abs(left->max), std::abs(left->min));
  };
  BOOST_TEST(balance(system_of("mechanical", {"q"},
                               {{"metric", 2},
                                {"potential", "9.81*(1-cos(q))"},
                                {"damping", 0.3},
                                {"forces", {"0.4*sin(t)"}}},
                               {{"q", 1}, {"p_q", 0}})) < 1e-12);
  BOOST_TEST(balance({{"system",
                       {{"type", "mechanical"},
                        {"manifold", "so3"},
                        {"coordinates", {"R[3][3]"}},
                        {"metric", {{1.4, 0, 0.3}, {0, 2.1, 0.4}, {0.3, 0.4, 1.7}}},
                        {"potential", "0.7*R[2][2]"},
                        {"damping", 0.2}}},
                      {"initial",
                       {{"R", {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}}, {"v_R", {0.6, -0.5, 0.15}}}}}) <
             1e-12);
}

BOOST_AUTO_TEST_CASE(velocities_of_other_kinds_are_refused) {
  for (const char* lagrangian : {"-sqrt(1-q'^2)-q^2/2", "q'^2*(1+t)-q^2/2"}) {
    const Problem problem = test::problem(
        system_of("lagrangian", {"q"}, {{"lagrangian", lagrangian}}, {{"q", 0.5}, {"q'", 0.1}}));
    try {
      problem.prepare("discrete-gradient", 0.1);
      BOOST_ERROR("taken: " << lagrangian);
    } catch (const std::invalid_argument& error) {
      BOOST_TEST(std::string(error.what()).find("controls that it is not quadratic in") !=
                     std::string::npos,
                 error.what());
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
