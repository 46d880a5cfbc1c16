#include "courant/running/left_constraints.hpp"

#include <boost/test/unit_test.hpp>

#include "run_in.hpp"

namespace courant {
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

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
