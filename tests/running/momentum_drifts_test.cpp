#include "courant/running/momentum_drifts.hpp"

#include <boost/test/unit_test.hpp>

#include "problems.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(momentum_drifts_test)

namespace {

const Json kepler = Json::parse(R"json({
  "system": { "type": "hamiltonian", "coordinates": ["x", "y"],
              "hamiltonian": "(p_x^2 + p_y^2)/2 - 1/sqrt(x^2 + y^2)" },
  "initial": { "x": 0.4, "y": 0, "p_x": 0, "p_y": 2 },
  "method": { "type": "discretize-first" },
  "time": { "step": 0.01, "end": 1 },
  "symmetries": { "L": { "x": "-y", "y": "x" } }
})json");

std::optional<VectorXd> drifts(const Json& method, double step = 0.01) {
  test::Problem problem = test::problem(kepler);
  problem.experiment.time->step = step;
  const PreparedMethod prepared = problem.prepare(method, step);
  return momentum_drifts(problem.experiment, *prepared.integrator, prepared.initial);
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_midpoint_rule_keeps_quadratic_momenta_and_others_do_not) {
  const auto midpoint = drifts({{"type", "discretize-first"}, {"discretization", "midpoint"}});
  BOOST_TEST_REQUIRE(midpoint.has_value());
  BOOST_TEST(midpoint->size() == 1);
  BOOST_TEST((*midpoint)[0] < 1e-12);
  const auto explicit_one = drifts({{"type", "rk2"}});
  BOOST_TEST_REQUIRE(explicit_one.has_value());
  BOOST_TEST((*explicit_one)[0] > 1e-9);
  BOOST_TEST((*explicit_one)[0] < 1e-2);
}

// The position after so long a step is no number.
BOOST_AUTO_TEST_CASE(steps_that_fail_have_no_drift) {
  BOOST_TEST(!drifts({{"type", "rk2"}}, 1e308).has_value());
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
