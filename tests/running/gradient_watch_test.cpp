#include "courant/running/gradient_watch.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "problems.hpp"
#include "run_in.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(gradient_watch_test)

// Mistakes that these cases have to notice:
//  * gradients that turn far in a long step count as turned round
//  * steps across a point without gradients are not looked at
//  * of dependent constraints each must have a gradient
//  * one that has none where the run begins ends it

namespace {

RunOutcome outcome(const Json& coordinates, const char* potential, const Json& holonomic,
                   const Json& initial, double step, double end) {
  const TemporaryFolder folder;
  return run_in(folder, {{"system",
                          {{"type", "mechanical"},
                           {"coordinates", coordinates},
                           {"potential", potential},
                           {"holonomic", holonomic}}},
                         {"initial", initial},
                         {"method", "constrain-first"},
                         {"time", {{"step", step}, {"end", end}}}});
}

}  // namespace

// A particle swings along a line of the cone, z = x, through its tip at t = π/4; with eight steps on the way, and with two.
BOOST_AUTO_TEST_CASE(the_tip_of_a_cone_ends_a_run) {
  for (const double step : {0.1, 0.2, 0.25, 0.3, 0.4}) {
    const RunOutcome run = outcome(
        {"x", "y", "z"}, "2*(x^2+y^2+z^2)", "x^2+y^2-z^2",
        {{"x", 1}, {"y", 0}, {"z", 1}, {"p_x", 0}, {"p_y", 0}, {"p_z", 0}}, step, 12.0 * step);
    BOOST_TEST_CONTEXT(step << ": " << run.message) {
      BOOST_TEST((run.status == RunStatus::failed));
      BOOST_TEST(run.message.find("gradients of the constraints vanish or turn") !=
                 std::string::npos);
      const double reached = static_cast<double>(run.summary.steps) * step;
      BOOST_TEST(reached > 0.7);
      BOOST_TEST(reached < 0.81 + step);
    }
  }
}

// x y = 0 follows from y = 0, and has no gradient at the origin.
BOOST_AUTO_TEST_CASE(a_constraint_that_follows_may_begin_without_a_gradient) {
  const RunOutcome run = outcome({"x", "y"}, "0*x", {"y", "x*y"},
                                 {{"x", 0}, {"y", 0}, {"p_x", 1}, {"p_y", 0}}, 0.125, 1.0);
  BOOST_TEST((run.status == RunStatus::completed), run.message);
  BOOST_TEST(std::abs(final_value(run, "x") - 1.0) <= 1e-12);
}

// A bob goes round by 109 degrees in a step, as far as its rod's direction turns: by a ninth of that in each part.
BOOST_AUTO_TEST_CASE(gradients_that_turn_far_do_not_turn_at_once) {
  const test::Problem pendulum =
      test::problem({{"system",
                      {{"type", "mechanical"},
                       {"coordinates", {"x", "y"}},
                       {"potential", "0*x"},
                       {"holonomic", "x^2+y^2-1"}}},
                     {"initial", {{"x", 1}, {"y", 0}, {"p_x", 0}, {"p_y", 1}}}});
  const PreparedMethod method = pendulum.prepare("constrain-first", 1.9);
  GradientWatch watch(method.integrator, method.initial);
  Step step;
  step.h = 1.9;
  step.before = step.after = method.initial;
  step.after.t = step.h;
  step.after.x << std::cos(1.9), std::sin(1.9), -std::sin(1.9), std::cos(1.9);
  const VectorXd row;
  BOOST_TEST(!watch.watch({.k = 1, .steps = 2, .t = step.h, .row = row, .step = step}));
}

// y = 0, said a second time by what says nothing at x = 1.
BOOST_AUTO_TEST_CASE(a_constraint_that_repeats_another_may_vanish) {
  for (const Json& holonomic : {Json{"y", "(x-1)*y"}, Json{"(x-1)*y", "y"}}) {
    const RunOutcome run = outcome({"x", "y"}, "0*x", holonomic,
                                   {{"x", 0}, {"y", 0}, {"p_x", 1}, {"p_y", 0}}, 0.03, 1.5);
    BOOST_TEST((run.status == RunStatus::completed), run.message);
  }
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
