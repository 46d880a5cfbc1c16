#include "courant/running/left_constraints.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "run_in.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * a constraint that is a twelfth of its terms is met
//  * what the middle of steps leaves of constraints is a finding
//  * what was left on the way is not looked at
//  * errors that alternate are not seen
//  * velocities and unknowns that nobody writes are not looked at
//  * errors that do not fall with the step are those of an order
BOOST_AUTO_TEST_SUITE(left_constraints_test)

namespace {

const Json kMethod1 = {{"type", "discretize-first"}};
const Json kMethod2 = {{"type", "constrain-first"}};

}  // namespace

// A point that a multiplier holds on a sphere, the multiplier a coordinate: index 4. By Method 1 the
// multiplier and with it the hidden constraints take any value, while H hardly moves.
BOOST_AUTO_TEST_CASE(a_run_that_leaves_the_constraints_says_so) {
  Json rotor = {{"system",
                 {{"type", "lagrangian"},
                  {"coordinates", {"x[3]", "l"}},
                  {"lagrangian", "(x[0]'^2+x[1]'^2+x[2]'^2)/2+l*(dot(x,x)-1)"}}},
                {"initial", {{"x", {0, 0, 1}}, {"p_x", {1, 0, 0}}}},
                {"time", {{"step", 0.01}, {"end", 1}}}};
  for (const Json& method : {kMethod1, kMethod2}) {
    rotor["method"] = method;
    const TemporaryFolder folder;
    const RunOutcome outcome = run_in(folder, rotor);
    BOOST_TEST_REQUIRE((outcome.status == RunStatus::completed));
    BOOST_TEST(outcome.summary.warnings.size() == (method == kMethod1 ? 1u : 0u));
    if (method == kMethod1)
      BOOST_TEST(outcome.summary.warnings.at(0).find("has left the constraints") !=
                 std::string::npos);
  }
  // At rest where all is zero, and where the middle of a step meets the constraint, not its end.
  Json pendulum = {
      {"system",
       {{"type", "implicit"},
        {"coordinates", {"x", "y", "v", "w"}},
        {"unknowns", {"l"}},
        {"equations", {"x' - v", "y' - w", "v' - l*x", "w' - l*y + 1", "x^2 + y^2 - 1"}}}},
      {"method", kMethod1},
      {"time", {{"step", 0.01}, {"end", 1}}}};
  for (const double x : {0.0, 0.6}) {
    pendulum["initial"] = {{"x", x}, {"y", x == 0.0 ? -1.0 : -0.8}, {"v", 0}, {"w", 0}};
    const TemporaryFolder folder;
    BOOST_TEST(run_in(folder, pendulum).summary.warnings.empty());
  }
}

// The index-3 problem of Hairer, Lubich and Roche, whose multiplier is not linear: Method 1 goes to
// z_1 = 3.73 where e is right, however short the steps are. The hidden constraint is a product of six
// coordinates and left by no more than a twelfth of what they count together.
BOOST_AUTO_TEST_CASE(a_constraint_of_many_factors_is_left_too) {
  Json problem = {{"system",
                   {{"type", "implicit"},
                    {"coordinates", {"y1", "y2", "z1", "z2"}},
                    {"unknowns", {"u"}},
                    {"equations",
                     {"y1' - 2*y1*y2*z1*z2", "y2' + y1*y2*z2^2", "z1' - (y1*y2 + z1*z2)*u",
                      "z2' + y1*y2^2*z2^2*u", "y1*y2^2 - 1"}}}},
                  {"initial", {{"y1", 1}, {"y2", 1}, {"z1", 1}, {"z2", 1}, {"u", 1}}}};
  const auto warnings = [&](const Json& method, double step, double end) {
    problem["method"] = method;
    problem["time"] = {{"step", step}, {"end", end}};
    const TemporaryFolder folder;
    const RunOutcome outcome = run_in(folder, problem);
    BOOST_TEST_REQUIRE((outcome.status == RunStatus::completed));
    return outcome.summary.warnings;
  };
  for (const double step : {0.01, 0.002})
    for (const double end : {0.2, 0.5}) {
      const auto found = warnings(kMethod1, step, end);
      BOOST_TEST_REQUIRE(found.size() == 1u);
      BOOST_TEST(found.at(0).find("constraint[1] is ") == 0u);
      BOOST_TEST(found.at(0).find("has left the constraints") != std::string::npos);
    }
  BOOST_TEST(warnings(kMethod2, 0.01, 0.5).empty());
}

// x = f(t) by midpoints: x_k + x_{k+1} = 2 f, and f is 1 at two of the midpoints and 0 at the others. The
// first sends x to 2, -2, 2, the second back to 0 for the rest of the run.
BOOST_AUTO_TEST_CASE(constraints_that_were_left_on_the_way_are_said) {
  Json bumps = {{"system",
                 {{"type", "implicit"},
                  {"coordinates", {"x"}},
                  {"equations", {"x - exp(-((t-1.05)/0.01)^2) - exp(-((t-1.35)/0.01)^2)"}}}},
                {"initial", {{"x", 0}}},
                {"method", kMethod1},
                {"time", {{"step", 0.1}, {"end", 2}}}};
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, bumps);
  BOOST_TEST(std::abs(final_value(outcome, "x")) < 1e-12);
  BOOST_TEST_REQUIRE(outcome.summary.warnings.size() == 1u);
  BOOST_TEST(outcome.summary.warnings.at(0).find("constraint[0] was up to 2 on the way") == 0u);
  // What is resolved is met on the way as well.
  bumps["system"]["equations"] = {"x - exp(-((t-1)/0.4)^2)"};
  const TemporaryFolder other;
  BOOST_TEST(run_in(other, bumps).summary.warnings.empty());
}

// Ascher and Petzold (1991): x = y = e^t, a linear problem of index 2 for which midpoints multiply
// what is beside the constraint by -(1 + 24 h) in each step. The constraint is half a percent of its
// terms all the way, since these grow as well.
BOOST_AUTO_TEST_CASE(a_motion_lost_in_alternating_errors_is_said) {
  Json problem = {{"system",
                   {{"type", "implicit"},
                    {"parameters", {{"a", 50}}},
                    {"coordinates", {"x", "y"}},
                    {"unknowns", {"z"}},
                    {"equations",
                     {"x' - (a - 1/(2-t))*x - (2-t)*a*z - (3-t)/(2-t)*exp(t)",
                      "y' - (1-a)/(t-2)*x + y - (a-1)*z - 2*exp(t)",
                      "(t+2)*x + (t^2-4)*y - (t^2+t-2)*exp(t)"}}}},
                  {"initial", {{"x", 1}, {"y", 1}}}};
  for (const Json& method : {kMethod1, kMethod2})
    for (const double step : {0.01, 0.005}) {
      problem["method"] = method;
      problem["time"] = {{"step", step}, {"end", 1}};
      const TemporaryFolder folder;
      const RunOutcome outcome = run_in(folder, problem);
      const bool is_right = std::abs(final_value(outcome, "x") - std::exp(1.0)) < 1e-2;
      BOOST_TEST(is_right == (method == kMethod2));
      BOOST_TEST_REQUIRE(outcome.summary.warnings.size() == (is_right ? 0u : 1u));
      if (!is_right)
        BOOST_TEST(outcome.summary.warnings.at(0).find("goes to and fro") != std::string::npos);
    }
}

// Method 1 on three arms that hold a platform, their rods a constraint each, which is left by 0.2 of 25 at all steps.
// A pendulum leaves its rod by less and less.
BOOST_AUTO_TEST_CASE(a_violation_that_stays_with_shorter_steps_is_said) {
  Json rods = Json::array();
  for (const char* k : {"0", "1", "2"}) {
    const std::string th = std::string("th") + k, angle = std::string(k) + "*2*pi/3";
    const std::string arm = "(2+cos(" + th + "))";
    rods.push_back("(x-" + arm + "*cos(" + angle + "))^2+(y-" + arm + "*sin(" + angle +
                   "))^2+(z+sin(" + th + "))^2-25");
  }
  const Json robot = {{"system",
                       {{"type", "mechanical"},
                        {"coordinates", {"x", "y", "z", "th0", "th1", "th2"}},
                        {"metric", {1, 1, 1, 0.2, 0.2, 0.2}},
                        {"potential", "9.81*z"},
                        {"holonomic", rods}}},
                      {"initial",
                       {{"x", 0},
                        {"y", 0},
                        {"z", -4},
                        {"th0", 0},
                        {"th1", 0},
                        {"th2", 0},
                        {"p_x", 0},
                        {"p_y", 0},
                        {"z'", 0.3}}},
                      {"method", kMethod1},
                      {"time", {{"step", 0.0125}, {"end", 0.6}}}};
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, robot);
  BOOST_TEST((outcome.status == RunStatus::completed));
  BOOST_TEST_REQUIRE(outcome.summary.warnings.size() == 1u);
  BOOST_TEST(outcome.summary.warnings[0].find("the method does not converge for this system") !=
                 std::string::npos,
             outcome.summary.warnings[0]);
  const Json pendulum = {{"system",
                          {{"type", "mechanical"},
                           {"coordinates", {"x", "y"}},
                           {"potential", "9.81*y"},
                           {"holonomic", "x^2+y^2-1"}}},
                         {"initial", {{"x", 1}, {"y", 0}, {"x'", 0}, {"y'", 0}}},
                         {"method", kMethod1},
                         {"time", {{"step", 0.05}, {"end", 1}}}};
  const TemporaryFolder other;
  for (const std::string& warning : run_in(other, pendulum).summary.warnings)
    BOOST_TEST(warning == "");
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
