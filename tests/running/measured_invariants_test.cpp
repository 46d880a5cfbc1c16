#include "courant/running/measured_invariants.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>

#include "problems.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * the first point alone says what is invariant
BOOST_AUTO_TEST_SUITE(measured_invariants_test)

namespace {

// A body in the plane around a centre; L is its momentum, and v_x depends on the velocity.
const Json kepler = Json::parse(R"json({
  "system": { "type": "hamiltonian", "coordinates": ["x", "y"],
              "hamiltonian": "(p_x^2 + p_y^2)/2 - 1/sqrt(x^2 + y^2)" },
  "initial": { "x": 0.4, "y": 0.1, "p_x": 0, "p_y": 2 },
  "symmetries": { "L": { "x": "-y", "y": "x" } },
  "observe": { "distance": "sqrt(x^2 + y^2)", "energy": "(p_x^2 + p_y^2)/2 - 1/sqrt(x^2 + y^2)",
               "v_x": "x'", "clock": "t" }
})json");

}  // namespace

BOOST_AUTO_TEST_CASE(what_stays_along_solutions_is_told_from_what_does_not) {
  const test::Problem problem = test::problem(kepler);
  const auto found = measured_invariants(problem.experiment, problem.ladder, {});
  std::vector<std::string> names;
  for (const MeasuredInvariant& of : found) names.push_back(of.name);
  BOOST_TEST(names == (std::vector<std::string>{"H", "L", "distance", "energy"}),
             boost::test_tools::per_element());
  for (const MeasuredInvariant& of : found) BOOST_TEST(of.is_invariant == (of.name != "distance"));
  // d/dt √(x² + y²) = (x p_x + y p_y)/√(x² + y²)
  BOOST_TEST(std::abs(found[2].rate - 0.2 / std::sqrt(0.17)) < 1e-14);
}

// Where a number vanishes by accident, other states tell.
BOOST_AUTO_TEST_CASE(all_states_count) {
  Json turning = kepler;
  turning["initial"]["y"] = 0;
  const test::Problem problem = test::problem(turning);
  const auto at_one = measured_invariants(problem.experiment, problem.ladder, {});
  BOOST_TEST(at_one[2].is_invariant);
  const VectorXd elsewhere{{0.4, 0.1, 0.0, 2.0}};
  const auto at_two = measured_invariants(problem.experiment, problem.ladder, {elsewhere});
  BOOST_TEST(!at_two[2].is_invariant);
}

BOOST_AUTO_TEST_CASE(nothing_is_said_where_there_is_no_vector_field) {
  test::Problem problem = test::problem(kepler);
  problem.ladder.verdict = Verdict::gauge;
  BOOST_TEST(measured_invariants(problem.experiment, problem.ladder, {}).empty());
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
