// What an experiment expects is measured on runs whose values are known in closed form, on both
// sides of each bound.
#include "courant/reading/expectation.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/running/run_files.hpp"
#include "run_in.hpp"

// Mistakes that these cases have to notice:
//  * a downward drift passes (reading/expectation.cpp)
//  * a value below the one expected passes (reading/expectation.cpp)
//  * lower bounds are upper ones (reading/expectation.cpp)
//  * a value below its closed form passes (running/observer.cpp)
//  * violations of positive values only (running/run_results.cpp)
//  * the violation of the first constraint only (running/run_results.cpp)
//  * a doubted verdict is taken for one that is certain (reading/expectation.cpp)
//  * runs do not see what constraints sees: that a switch is at its edge (running/consistent_start.hpp)
BOOST_AUTO_TEST_SUITE(expectations)

using namespace courant;

namespace {

// x' = rate from x = 0 to t = 1.
Json straight(double rate) {
  return {{"system",
           {{"type", "implicit"},
            {"parameters", {{"rate", rate}}},
            {"coordinates", {"x"}},
            {"equations", {"x' - rate"}}}},
          {"initial", {{"x", 0}}},
          {"method", "discretize-first"},
          {"time", {{"step", 0.1}, {"end", 1}}}};
}

// The midpoint rule on x' = 1, y = a x², w = b x²: the constraints hold in the middle of a step,
// so that y - a x² = -a h²/2 after odd steps and 0 after even ones; likewise w.
Json parabolas(double a, double b) {
  return {{"system",
           {{"type", "implicit"},
            {"parameters", {{"a", a}, {"b", b}}},
            {"coordinates", {"x", "y", "w"}},
            {"equations", {"x' - 1", "y - a*x^2", "w - b*x^2"}}}},
          {"initial", {{"x", 0}, {"y", 0}, {"w", 0}}},
          {"method", "discretize-first"},
          {"time", {{"step", 0.1}, {"end", 1}}}};
}

ExpectationResult result(Json experiment, const Json& expectation) {
  const TemporaryFolder folder;
  experiment["expect"] = {expectation};
  const RunOutcome outcome = run_in(folder, experiment);
  BOOST_REQUIRE_EQUAL(outcome.expectations.size(), 1U);
  return outcome.expectations.front();
}

bool passes(const Json& experiment, const Json& expectation) {
  return result(experiment, expectation).passed;
}

}  // namespace

// Upwards or downwards, a drift is a drift.
BOOST_AUTO_TEST_CASE(slopes_and_drifts_have_no_sign) {
  for (const double rate : {1.0, -1.0}) {
    const Json experiment = straight(rate);
    BOOST_TEST(!passes(experiment, {{"observable", "x"}, {"max_slope", 0.9}}));
    BOOST_TEST(passes(experiment, {{"observable", "x"}, {"max_slope", 1.1}}));
    BOOST_TEST(!passes(experiment, {{"observable", "x"}, {"max_drift", 0.9}}));
    BOOST_TEST(passes(experiment, {{"observable", "x"}, {"max_drift", 1.1}}));
    BOOST_TEST(passes(experiment, {{"observable", "x"}, {"min_drift", 0.9}}));
    BOOST_TEST(!passes(experiment, {{"observable", "x"}, {"min_drift", 1.1}}));
    const ExpectationResult slope = result(experiment, {{"observable", "x"}, {"max_slope", 0.9}});
    BOOST_TEST(slope.value.get<double>() == 1.0, boost::test_tools::tolerance(1e-12));
  }
}

// A value below a closed form is as far from it as one above.
BOOST_AUTO_TEST_CASE(distances_from_closed_forms_have_no_sign) {
  for (const double rate : {1.0, -1.0}) {
    const Json experiment = straight(rate);
    for (const char* wrong : {"2*t", "-2*t", "0"}) {
      const bool twice = wrong[0] != '0' && (wrong[0] == '-') == (rate < 0.0);
      const double off = twice || wrong[0] == '0' ? 1.0 : 3.0;
      for (const bool at_the_end : {false, true}) {
        Json expectation = {{"state", {{"x", wrong}}}, {"tolerance", 0.9 * off}};
        if (at_the_end) expectation["at"] = 1;
        BOOST_TEST(!passes(experiment, expectation));
        expectation["tolerance"] = 1.1 * off;
        BOOST_TEST(passes(experiment, expectation));
      }
    }
    BOOST_TEST(
        passes(experiment, {{"state", {{"x", rate > 0.0 ? "t" : "-t"}}}, {"tolerance", 1e-13}}));
  }
}

// The greatest |constraint|, of all constraints, whatever their signs.
BOOST_AUTO_TEST_CASE(violations_are_of_all_constraints_and_both_signs) {
  const std::pair<double, double> curvatures[] = {{1, 3}, {3, 1}, {-1, -3}, {-3, -1}, {1, -3}};
  for (const auto& [a, b] : curvatures) {
    const ExpectationResult violation = result(parabolas(a, b), {{"max_violation", 0.0149}});
    BOOST_TEST(violation.value.get<double>() == 3.0 * 0.01 / 2.0,
               boost::test_tools::tolerance(1e-10));
    BOOST_TEST(!violation.passed);
    BOOST_TEST(passes(parabolas(a, b), {{"max_violation", 0.0151}}));
  }
}

// The constraint of a pendulum and the hidden one behind it are columns of the trajectory, with
// the values that the coordinates of the row give them.
BOOST_AUTO_TEST_CASE(hidden_constraints_have_columns) {
  const TemporaryFolder folder;
  const Json experiment = {
      {"system",
       {{"type", "implicit"},
        {"coordinates", {"x", "y", "v", "w"}},
        {"unknowns", {"tension"}},
        {"equations",
         {"x' - v", "y' - w", "v' + tension*x", "w' + tension*y + 1", "x^2 + y^2 - 1"}}}},
      {"initial", {{"x", 0.6}, {"y", -0.8}, {"v", 0.8}, {"w", 0.6}}},
      {"method", "rk2"},
      {"time", {{"step", 0.1}, {"end", 1}}}};
  const RunOutcome outcome = run_in(folder, experiment);
  BOOST_TEST((outcome.status == RunStatus::completed), outcome.message);
  const auto table = read_run(folder / "run").trajectory;
  const auto x = table.column("x"), y = table.column("y"), v = table.column("v"),
             w = table.column("w");
  const auto length = table.column("constraint[0]"), hidden = table.column("constraint[1]");
  double greatest = 0.0;
  for (std::size_t k = 0; k < table.rows(); ++k) {
    BOOST_TEST(std::abs(length[k] - (x[k] * x[k] + y[k] * y[k] - 1.0)) < 1e-14);
    BOOST_TEST(std::abs(hidden[k] - 2.0 * (x[k] * v[k] + y[k] * w[k])) < 1e-14);
    greatest = std::max({greatest, std::abs(length[k]), std::abs(hidden[k])});
  }
  BOOST_TEST(greatest > 1e-5);  // the method keeps neither
  BOOST_TEST(outcome.summary.max_violation.value() == greatest);
}

// y = |x| with x' = 1: at x = 0 the two sides have other slopes, and the verdict is doubted.
BOOST_AUTO_TEST_CASE(a_doubted_verdict_is_met_by_a_doubted_one_alone) {
  const auto from = [](double x) {
    return Json{{"system",
                 {{"type", "implicit"},
                  {"coordinates", {"x", "y"}},
                  {"equations", {"x' - 1", "y - abs(x)"}}}},
                {"initial", {{"x", x}}}};
  };
  const Json certain = {{"verdict", "regular"}},
             doubted = {{"verdict", "regular"}, {"doubted", true}};
  BOOST_TEST(!passes(from(0.0), certain));
  BOOST_TEST(passes(from(0.0), doubted));
  BOOST_TEST(passes(from(1.0), certain));
  BOOST_TEST(!passes(from(1.0), doubted));

  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, from(0.0));
  BOOST_TEST_REQUIRE(outcome.summary.ladder->doubts.size() == 1u);
  BOOST_TEST((outcome.summary.ladder->doubts[0].kind == Doubt::Kind::at_switch));
}

BOOST_AUTO_TEST_SUITE_END()
