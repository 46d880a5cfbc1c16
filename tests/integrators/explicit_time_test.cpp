// Systems that depend on time, from starts at other times than 0 and with stages off the middle: at
// which times the methods evaluate them is seen in closed form.
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/constrain_first.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/integrators/methods/explicit_runge_kutta.hpp"
#include "courant/tests/integrators/certificate/ladder_catalogue.hpp"

// Mistakes that these cases have to notice:
//  * Method 1 evaluates at the start of a step (integrators/step/stage_step.cpp)
//  * steps forget when they started (integrators/step/stepper.cpp)
//  * Method 2 evaluates in the middle, wherever its stage is
//    (integrators/methods/constrain_first_trace.cpp)
//  * Method 2 projects at the time where the step began (integrators/methods/constrain_first.cpp)
//  * Method 2 brings its start to M_f of time 0 (integrators/methods/constrain_first.cpp)
//  * the stages of explicit methods are those of a step from time 0
//    (integrators/methods/explicit_runge_kutta.cpp)
//  * two nodes of Fehlberg's method change places (integrators/methods/explicit_runge_kutta.cpp)
//  * the stage is on the other side of the middle (integrators/maps/theta.cpp)
BOOST_AUTO_TEST_SUITE(explicit_time)

using namespace courant;

namespace {

constexpr double kStart = 1.7;
constexpr double kStep = 0.3;

std::shared_ptr<const Theta> theta(const ImplicitSystem& system, double value) {
  return std::make_shared<Theta>(system.manifold(), value);
}

// w' = cos t.
examples::SystemPointer rate() {
  return examples::flat(
      1, 0, 1, [](const ExprVector&, const ExprVector& v, const ExprVector&, const Expr& t) {
        return examples::equations({v[0] - cos(t)});
      });
}

// w' = cos t beside a point on a line that turns, x' = 1 and y = t² x.
examples::SystemPointer turning_line() {
  return examples::flat(
      3, 0, 3, [](const ExprVector& x, const ExprVector& v, const ExprVector&, const Expr& t) {
        return examples::equations({v[0] - cos(t), v[1] - 1.0, x[2] - square(t) * x[1]});
      });
}

ConstraintLadder ladder(const examples::SystemPointer& system, const VectorXd& x) {
  return ConstraintAlgorithm().run(system, {.t = kStart, .x = x});
}

}  // namespace

// w_{k+1} = w_k + h cos(t_k + θ h), t_k = t_0 + k h.
BOOST_AUTO_TEST_CASE(method_1_evaluates_at_its_stage) {
  const auto system = rate();
  for (const double value : {0.0, 0.3, 0.5, 1.0}) {
    const DiscretizeFirst method(system, theta(*system, value));
    const auto stepper = method.stepper();
    State state{.t = kStart, .x = VectorXd::Constant(1, 0.4)};
    double expected = 0.4;
    for (int k = 0; k < 3; ++k) {
      stepper->step(state, kStep, kStart + (k + 1) * kStep);
      expected += kStep * std::cos(kStart + (k + value) * kStep);
      BOOST_TEST(state.x[0] == expected, boost::test_tools::tolerance(1e-14));
      BOOST_TEST(state.t == kStart + (k + 1) * kStep);
    }
  }
}

// The same of w by Method 2, whose points lie on the line of the time that they belong to.
BOOST_AUTO_TEST_CASE(method_2_evaluates_at_its_stage_and_projects_at_the_ends) {
  const auto system = turning_line();
  const VectorXd x0 = VectorXd{{0.4, 1.0, kStart * kStart}};
  for (const double value : {0.0, 0.3, 0.5, 1.0}) {
    const ConstrainFirst method(system, ladder(system, x0), theta(*system, value),
                                std::make_shared<OrthogonalProjector>());
    const auto stepper = method.stepper();
    State state{.t = kStart, .x = x0};
    stepper->prepare(state, kStep);
    BOOST_TEST((state.x - x0).norm() < 1e-14);
    double expected = 0.4;
    for (int k = 0; k < 3; ++k) {
      stepper->step(state, kStep, kStart + (k + 1) * kStep);
      const VectorXd& x = state.x;
      expected += kStep * std::cos(kStart + (k + value) * kStep);
      BOOST_TEST(x[0] == expected, boost::test_tools::tolerance(1e-13));
      const double t = kStart + (k + 1) * kStep;
      BOOST_TEST(x[2] == t * t * x[1], boost::test_tools::tolerance(1e-13));
      BOOST_TEST(state.t == t);
    }
  }
}

// A start off the line is brought to the line of its own time.
BOOST_AUTO_TEST_CASE(method_2_starts_at_its_own_time) {
  const auto system = turning_line();
  const VectorXd x0 = VectorXd{{0.4, 1.0, kStart * kStart}};
  const ConstrainFirst method(system, ladder(system, x0), theta(*system, 0.5),
                              std::make_shared<OrthogonalProjector>());
  State state{.t = kStart, .x = x0 + VectorXd{{0.0, 0.0, 0.1}}};
  method.stepper()->prepare(state, kStep);
  const VectorXd& x = state.x;
  BOOST_TEST(x[2] == kStart * kStart * x[1], boost::test_tools::tolerance(1e-13));
  BOOST_TEST(x[0] == 0.4);
}

// Each by its tableau on w' = cos t: midpoint, Simpson's rule for the classical method.
BOOST_AUTO_TEST_CASE(explicit_methods_evaluate_at_their_nodes) {
  const auto system = rate();
  const VectorXd w0 = VectorXd::Constant(1, 0.4);
  const auto field =
      std::make_shared<VectorField>(system, ladder(system, w0), Backend::interpreter);
  using Kind = ExplicitRungeKutta::Kind;
  const auto end = [&](Kind kind) {
    const State state = ExplicitRungeKutta(field, kind).advance({.t = kStart, .x = w0}, kStep, 2);
    BOOST_TEST(state.t == kStart + 2.0 * kStep);
    return state.x[0];
  };
  const auto f = [](double steps) { return std::cos(kStart + steps * kStep); };
  BOOST_TEST(end(Kind::midpoint) == 0.4 + kStep * (f(0.5) + f(1.5)),
             boost::test_tools::tolerance(1e-14));
  BOOST_TEST(end(Kind::classical) ==
                 0.4 + kStep / 6.0 * (f(0.0) + 4.0 * f(0.5) + 2.0 * f(1.0) + 4.0 * f(1.5) + f(2.0)),
             boost::test_tools::tolerance(1e-14));
  BOOST_TEST(end(Kind::dormand_prince) == 0.4 + std::sin(kStart + 2.0 * kStep) - std::sin(kStart),
             boost::test_tools::tolerance(1e-6));
  BOOST_TEST(end(Kind::fehlberg) == 0.4 + std::sin(kStart + 2.0 * kStep) - std::sin(kStart),
             boost::test_tools::tolerance(1e-10));
}

BOOST_AUTO_TEST_SUITE_END()
