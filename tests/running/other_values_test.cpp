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

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
