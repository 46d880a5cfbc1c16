#include "courant/running/other_values.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

namespace courant {
BOOST_AUTO_TEST_SUITE(other_values_test)

namespace {

LadderReport report(const char* unknowns, const char* equations, const char* initial) {
  const Experiment experiment = read_experiment(
      std::string(R"({"system": {"type": "implicit", "coordinates": ["x", "v"], "unknowns": )") +
      unknowns + R"(, "equations": )" + equations + R"(}, "initial": )" + initial + "}");
  return report_of_start(experiment, consistent_start(experiment));
}

}  // namespace

// x² + y² = 1 at x = 0: y = 1 and y = -1.
BOOST_AUTO_TEST_CASE(the_other_branch_is_told) {
  const char* const circle = R"(["x' - v", "v' + y - x", "x^2 + y^2 - 1"])";
  const auto found = report(R"(["y"])", circle, R"({"x": 0, "v": 1})");
  BOOST_TEST_REQUIRE(found.choices.size() == 1u);
  BOOST_TEST(found.choices[0].name == "y");
  BOOST_TEST(std::abs(std::abs(found.choices[0].from) - 1.0) < 1e-12);
  BOOST_TEST(std::abs(found.choices[0].from + found.choices[0].to) < 1e-12);
  BOOST_TEST(read_ladder_report(to_json(found)).choices.size() == 1u);
  // What is given was chosen.
  BOOST_TEST(report(R"(["y"])", circle, R"({"x": 0, "v": 1, "y": 1})").choices.empty());
}

BOOST_AUTO_TEST_CASE(an_unknown_that_has_one_value_is_none) {
  BOOST_TEST(report(R"(["y"])", R"(["x' - v", "v' + y - x", "2*y - x - 3"])", R"({"x": 0, "v": 1})")
                 .choices.empty());
  BOOST_TEST(report(R"(["y"])", R"(["x' - v", "v' + y - x", "y^3 + y - 2"])", R"({"x": 0, "v": 1})")
                 .choices.empty());
}

// A pendulum of length l on a rod, whose tension is 2 λ l.
BOOST_AUTO_TEST_CASE(formulas_have_parameters_by_name) {
  const Experiment experiment = read_experiment(R"({
    "system": {"type": "implicit", "coordinates": ["x", "y", "v", "w"], "unknowns": ["lambda"],
               "parameters": {"m": 2, "g": 9.81, "l": 1.5, "wind": 0},
               "equations": ["x' - v", "y' - w", "m*v' + 2*lambda*x - wind*m", "m*w' + 2*lambda*y + m*g",
                             "x^2 + y^2 - l^2"]},
    "initial": {"x": 0.9, "y": -1.2, "v": 0.8, "w": 0.6}})");
  const ConstraintFormulas found = formulas_of_start(experiment, consistent_start(experiment));
  BOOST_TEST_REQUIRE(found.constraints.size() == 2u);
  BOOST_TEST(found.constraints[0].formula == "x^2 + y^2 - l^2");
  BOOST_TEST(found.constraints[1].formula == "x*v + y*w");
  BOOST_TEST_REQUIRE(found.values.size() == 1u);
  BOOST_TEST(found.values[0].formula == "m*(v^2 + w^2 - g*y)/(2*l^2)");
}

// A bound of a sum is an integer and no name.
BOOST_AUTO_TEST_CASE(what_counts_terms_is_a_number) {
  const Experiment experiment = read_experiment(R"json({
    "system": {"type": "implicit", "coordinates": ["x[3]"], "parameters": {"n": 3, "k": 2},
               "equations": ["x[0]' - k*x[1]", "x[1]' + k*x[2]", "sum(i, 0, n - 1, x[i])"]},
    "initial": {"x": [1, 0, -1]}})json");
  const ConstraintFormulas found = formulas_of_start(experiment, consistent_start(experiment));
  BOOST_TEST_REQUIRE(found.velocities.size() == 3u);
  BOOST_TEST(found.velocities[0].formula == "k*x[1]");
}

// That a - b is 0 only the numbers say: x = 0 is a constraint, and y = 0 then too.
BOOST_AUTO_TEST_CASE(formulas_have_numbers_where_names_say_less) {
  const Experiment experiment = read_experiment(R"({
    "system": {"type": "implicit", "coordinates": ["x", "y"], "parameters": {"a": 2, "b": 2},
               "equations": ["x' - b*y", "(a - b)*y' + x"]},
    "initial": {"x": 0, "y": 0}})");
  const ConstraintFormulas found = formulas_of_start(experiment, consistent_start(experiment));
  BOOST_TEST_REQUIRE(found.constraints.size() == 2u);
  BOOST_TEST(found.constraints[0].formula == "x");
  BOOST_TEST(found.constraints[1].formula == "y");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
