#include "courant/running/branch_report.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>

#include "../core/files/temporary_folder.hpp"
#include "courant/running/consistent_start.hpp"
#include "run_in.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * "branch" is read and the whole system is run
//  * a number that no branch has is taken for the last one
//  * branches are looked for in what is left of a branch that was chosen
//  * a branch that the initial values are not on is run from where they are
BOOST_AUTO_TEST_SUITE(branch_report_test)

namespace {

// x y = 0, x' + y' = 1. From beside a branch an impulse leads to it, along which x + y stays.
Json cross(Json branch, double x, double y) {
  Json experiment = {
      {"system",
       {{"type", "implicit"}, {"coordinates", {"x", "y"}}, {"equations", {"x*y", "x' + y' - 1"}}}},
      {"initial", {{"x", x}, {"y", y}}},
      {"start", "nearest"}};
  if (!branch.is_null()) experiment["branch"] = std::move(branch);
  return experiment;
}

Json with_method(Json experiment, const std::string& type, double end) {
  experiment["method"] = {{"type", type}, {"discretization", "midpoint"}};
  experiment["time"] = {{"step", 0.01}, {"end", end}};
  return experiment;
}

std::string refusal(const Json& experiment) {
  try {
    read_experiment_document(experiment);
  } catch (const ExperimentError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_number_that_no_branch_has_is_refused) {
  BOOST_TEST(refusal(cross(3, 0, 0)) ==
             "/branch: is 3, and there are 2 branches; expected a number from 1 to 2");
  BOOST_TEST(refusal(cross(0, 0, 0)).find("/branch") == 0u);
  BOOST_TEST(refusal(cross("y", 0, 0)).find("/branch") == 0u);
  Json circle = cross(1, 1, 0);
  circle["system"]["equations"][0] = "x^2 + y^2";
  BOOST_TEST(refusal(circle) ==
             "/branch: is 1, and none of the equations is seen to be a product; expected no "
             "\"branch\"");
  BOOST_TEST(refusal(cross(2, 0, 0)).empty());
}

// From (-0.5, 0) along y = 0 through the crossing, x = t - 0.5; from there along x = 0, y = t. Also from beside it.
BOOST_AUTO_TEST_CASE(runs_stay_on_their_branch_by_both_methods) {
  for (const std::string method : {"discretize-first", "constrain-first"}) {
    const TemporaryFolder folder;
    const RunOutcome through = run_in(folder, with_method(cross(2, -0.5, 0.0), method, 1.0));
    BOOST_TEST((through.summary.status == RunStatus::completed), through.summary.message);
    BOOST_TEST(std::fabs(final_value(through, "x") - 0.5) < 1e-12);
    BOOST_TEST(std::fabs(final_value(through, "y")) < 1e-14);
    const TemporaryFolder other, third;
    const RunOutcome up = run_in(other, with_method(cross(1, 0.0, 0.0), method, 1.0));
    BOOST_TEST(std::fabs(final_value(up, "y") - 1.0) < 1e-12);
    BOOST_TEST(std::fabs(final_value(up, "x")) < 1e-14);
    const RunOutcome beside = run_in(third, with_method(cross(1, 0.01, 0.3), method, 1.0));
    BOOST_TEST(std::fabs(final_value(beside, "y") - 1.31) < 1e-12);
    BOOST_TEST(std::fabs(final_value(beside, "x")) < 1e-14);
  }
}

BOOST_AUTO_TEST_CASE(all_branches_are_told_with_their_ladders) {
  for (const Json& number : {Json(), Json(1), Json(2)}) {
    const Experiment experiment = read_experiment_document(cross(number, 0.0, 0.3));
    const std::vector<BranchReport> found = branch_reports(experiment);
    BOOST_TEST_REQUIRE(found.size() == 2u);
    for (const BranchReport& branch : found) {
      BOOST_TEST(branch.is_chosen == (Json(branch.number) == number));
      BOOST_TEST(to_string(branch.ladder.verdict) == "regular");
      BOOST_TEST(branch.ladder.degrees_of_freedom.value_or(-1) == 1);
    }
    BOOST_TEST(found[0].equations == std::vector<std::string>{"x"});
    BOOST_TEST(found[0].moved == 0.0);
    BOOST_TEST(std::fabs(found[1].moved - 0.3 * std::sqrt(2.0)) < 1e-12);
    const Json json = with_branches(Json::object(), found);
    BOOST_TEST(json.at("branches").at(1).at("equations").at(0) == "y");
    BOOST_TEST(json.at("branches").at(1).at("ladder") == Json::parse("[[2, 1], [1, 1]]"));
  }
  Json regular = cross(Json(), 1.0, 0.0);
  regular["system"]["equations"][0] = "x^2 + y^2 - 1";
  BOOST_TEST(branch_reports(read_experiment_document(regular)).empty());
}

// A pendulum on the circle of (x - y) (x² + y² - 1) = 0 swings through the line: its angle from the lowest point is that of
// θ'' = -sin θ, in the units of the pendulum, by the energy p²/2 + y.
BOOST_AUTO_TEST_CASE(a_pendulum_swings_through_a_crossing) {
  Json experiment = {{"system",
                      {{"type", "mechanical"},
                       {"coordinates", {"x", "y"}},
                       {"potential", "y"},
                       {"holonomic", "(x - y)*(x^2 + y^2 - 1)"}}},
                     {"branch", 2},
                     {"initial", {{"x", -0.6}, {"y", -0.8}, {"p_x", 0}, {"p_y", 0}}}};
  const TemporaryFolder folder;
  // θ₀ = asin 0.6 is less than π/4: nothing is crossed. With a momentum the pendulum passes (-1, -1)/√2.
  experiment["initial"]["p_x"] = -0.8;
  experiment["initial"]["p_y"] = 0.6;
  const RunOutcome outcome = run_in(folder, with_method(experiment, "constrain-first", 3.0));
  BOOST_TEST((outcome.summary.status == RunStatus::completed), outcome.summary.message);
  double angle = -std::asin(0.6), rate = -1.0;
  const int steps = 30000;
  const double h = 3.0 / steps;
  double smallest = angle;
  for (int i = 0; i < steps; ++i) {  // Störmer and Verlet
    rate -= 0.5 * h * std::sin(angle);
    angle += h * rate;
    rate -= 0.5 * h * std::sin(angle);
    smallest = std::min(smallest, angle);
  }
  BOOST_TEST(smallest < -1.0);  // beyond -π/4
  BOOST_TEST(std::fabs(final_value(outcome, "x") - std::sin(angle)) < 1e-4);
  BOOST_TEST(std::fabs(final_value(outcome, "y") + std::cos(angle)) < 1e-4);
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
