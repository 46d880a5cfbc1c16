// The table of docs/errata.md: Section 6.3 with h = 1, figures computed independently.
#include <boost/test/unit_test.hpp>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/function.hpp"
#include "courant/integrators/methods/explicit_runge_kutta.hpp"
#include "courant/tests/integrators/vortices.hpp"

BOOST_AUTO_TEST_SUITE(vortices_long)

using namespace courant;
using namespace courant::vortices;

namespace {

struct Row {
  double x1, x2, y1, y2, drift;
};

double worst_energy_error(const Integrator& method, State state, long steps, Row* at_300) {
  Graph graph;
  const ExprVector q = graph.variables("q", 8);
  const Function H("H", {{"q", q}}, ExprVector::Constant(1, hamiltonian(q)));
  const auto energy = [&] {
    const double* in[] = {state.x.data()};
    double value;
    H.value(in, &value);
    return value;
  };
  const double start = energy();
  BOOST_TEST(start == -0.697421199668691, boost::test_tools::tolerance(1e-14));
  const auto stepper = method.stepper();
  double worst = 0.0;
  for (long k = 1; k <= steps; ++k) {
    stepper->step(state, 1.0);
    worst = std::max(worst, std::abs(energy() - start));
    if (k != 300) continue;
    const VectorXd& x = state.x;
    *at_300 = {x[0], x[1], x[4], x[5], worst};
  }
  return worst;
}

// Compares the state at t = 300; returns the worst energy error of all steps.
double compare(const Integrator& method, const VectorXd& x0, long steps, const Row& expected) {
  Row found{};
  const double drift = worst_energy_error(method, {.x = x0}, steps, &found);
  BOOST_TEST(std::abs(found.x1 - expected.x1) < 1e-8);
  BOOST_TEST(std::abs(found.x2 - expected.x2) < 1e-8);
  BOOST_TEST(std::abs(found.y1 - expected.y1) < 1e-8);
  BOOST_TEST(std::abs(found.y2 - expected.y2) < 1e-8);
  BOOST_TEST(found.drift == expected.drift, boost::test_tools::tolerance(5e-4));
  return drift;
}

constexpr long kSteps = 1'000'000;

std::shared_ptr<const VectorField> regular_field() {
  const auto system = regular_form();
  return std::make_shared<VectorField>(
      system, ConstraintAlgorithm().run(system, {.x = positions()}), Backend::automatic);
}

}  // namespace

BOOST_AUTO_TEST_CASE(section_6_3_rk2) {
  const ExplicitRungeKutta rk2(regular_field(), ExplicitRungeKutta::Kind::midpoint);
  const Row expected{24.4917867898, 22.5101278137, 2.1141321862, 1.8858678138, 4.117e-4};
  // In the first 10⁴ steps the drift is the method's, whatever the rounding. Later round-off breaks
  // the mirror symmetry and the pairs part: two orders of summation and long double give 0.11, 0.15
  // and 0.11 at 10⁶ (docs/errata.md).
  BOOST_TEST(compare(rk2, positions(), 10'000, expected) == 8.607e-3,
             boost::test_tools::tolerance(5e-4));
  const double drift = compare(rk2, positions(), kSteps, expected);
  BOOST_TEST(drift > 0.08);
  BOOST_TEST(drift < 0.2);
}

BOOST_AUTO_TEST_CASE(section_6_3_method_1_with_the_first_step_of_rk2) {
  // p₀ = -D₁L_d(q₀, q₁) with q₁ from RK2.
  const ExplicitRungeKutta rk2(regular_field(), ExplicitRungeKutta::Kind::midpoint);
  const VectorXd q0 = positions();
  const VectorXd q1 = one_step(rk2, q0, 1.0);
  Graph graph;
  const ExprVector a = graph.variables("q0", 8);
  const ExprVector b = graph.variables("q1", 8);
  const ExprVector middle = Expr(0.5) * (a + b);
  const Expr discrete_lagrangian = alpha(middle).dot(b - a) - hamiltonian(middle);
  const Function p0("p0", {{"q0", a}, {"q1", b}}, ExprVector(-gradient(discrete_lagrangian, a)));
  const Degenerate vortices = lagrangian_form();
  VectorXd x0(16);
  x0 << q0, p0({q0, q1});
  const double drift =
      compare(*vortices.method_1(), x0, kSteps,
              {24.4706548726, 22.5201202714, 2.1769853989, 1.8230146012, 1.921e-4});
  BOOST_TEST(drift == 1.935e-4, boost::test_tools::tolerance(5e-4));
}

BOOST_AUTO_TEST_CASE(section_6_3_method_2) {
  const Degenerate vortices = lagrangian_form();
  const auto method =
      vortices.method_2(positions(), std::make_shared<MomentumProjector>(vortices.phase_space));
  const double drift =
      compare(*method, vortices.over(positions()), kSteps,
              {24.4706087911, 22.5201596690, 2.1771929466, 1.8228070534, 1.596e-4});
  BOOST_TEST(drift == 1.600e-4, boost::test_tools::tolerance(5e-4));
}

BOOST_AUTO_TEST_SUITE_END()
