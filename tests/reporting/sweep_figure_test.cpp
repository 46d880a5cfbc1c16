#include "courant/reporting/sweep_figure.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/reporting/study_figure.hpp"

// Mistakes that these cases have to notice:
//  * references that differ are not told (reporting/study_figure.cpp)
BOOST_AUTO_TEST_SUITE(sweep_figure_test)

using namespace courant;

namespace {

Json run(const Json& settings, const Json& values) {
  return {{"folder", "a"},
          {"settings", settings},
          {"status", "completed"},
          {"message", ""},
          {"values", values}};
}

// Greatest drifts h² over steps, for two methods.
Json table() {
  Json all = {{"sweep", Json::array()}, {"runs", Json::array()}};
  all["sweep"] = {{{"pointer", "/time/step"}, {"values", {0.001, 0.01, 0.1}}},
                  {{"pointer", "/method"}, {"values", {"rk2", "rk4"}}}};
  for (const double h : {0.001, 0.01, 0.1})
    for (const char* method : {"rk2", "rk4"})
      all["runs"].push_back(
          run({{"/time/step", h}, {"/method", method}}, {{"H.max_drift", h * h},
                                                         {"H.final", 1.0},
                                                         {"q.final", 2.0},
                                                         {"spread.final", h},
                                                         {"spread.max_drift", 1.0},
                                                         {"verdict", "regular"}}));
  return all;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_curve_for_each_value_of_the_other_places) {
  const auto figure = sweep_figure(table());
  BOOST_TEST_REQUIRE(figure.has_value());
  BOOST_TEST_REQUIRE(figure->panels.size() == 2u);  // H, and where the observable ends
  const plot::Panel& energy = figure->panels[0];
  BOOST_TEST(energy.x.label == "step");
  BOOST_TEST_REQUIRE(energy.series.size() == 2u);
  BOOST_TEST(energy.series[1].label == "method = rk4");
  BOOST_CHECK(energy.series[1].x == (std::vector<double>{0.001, 0.01, 0.1}));
  BOOST_TEST(energy.series[1].y[2] == 0.1 * 0.1);
  BOOST_TEST(std::dynamic_pointer_cast<const plot::LogScale>(energy.x.scale) != nullptr);
  BOOST_TEST(std::dynamic_pointer_cast<const plot::LogScale>(energy.y.scale) != nullptr);
  BOOST_TEST(figure->panels[1].y.label == "spread at the end");
  BOOST_TEST(figure->legend.size() == 2u);
  BOOST_TEST(figure->caption == "A sweep over step and method.");
}

BOOST_AUTO_TEST_CASE(words_have_an_axis_too_and_failures_are_gaps) {
  Json all = table();
  std::swap(all["sweep"][0], all["sweep"][1]);
  for (Json& one : all["runs"]) {
    const Json settings = one["settings"];
    one["settings"] = {{"/method", settings["/method"]}, {"/time/step", settings["/time/step"]}};
  }
  all["runs"][1]["values"] = Json::object();  // rk4 at the first step
  const auto figure = sweep_figure(all);
  BOOST_TEST_REQUIRE(figure.has_value());
  const plot::Series& first = figure->panels[0].series[0];
  BOOST_CHECK(first.x == (std::vector<double>{0, 1}));
  BOOST_TEST(std::isnan(first.y[1]));
  BOOST_TEST(figure->panels[0].x.scale->ticks({-0.5, 1.5}, 5).marks[1].label == "rk4");
}

BOOST_AUTO_TEST_CASE(without_numbers_there_is_no_figure) {
  Json all = table();
  for (Json& one : all["runs"]) one["values"] = {{"verdict", "regular"}};
  BOOST_TEST(!sweep_figure(all).has_value());
}

BOOST_AUTO_TEST_CASE(a_study_is_drawn_over_step_and_time) {
  StudyReport study;
  study.methods = {
      {.experiment = "a",
       .method = "rk2",
       .reference = "closed form",
       .order = 2.0,
       .rows = {{.step = 0.1, .error = 1e-2, .seconds = 1e-3}, {.step = 0.05, .seconds = 2e-3}}}};
  const auto figure = study_figure(study);
  BOOST_TEST_REQUIRE(figure.has_value());
  BOOST_TEST_REQUIRE(figure->panels.size() == 2u);
  BOOST_CHECK(figure->panels[0].series[0].x == (std::vector<double>{0.1, 0.05}));
  BOOST_TEST(std::isnan(figure->panels[0].series[0].y[1]));
  BOOST_TEST(figure->panels[1].series[0].x[0] == 1e-3);
  BOOST_TEST(figure->legend[0].label == "rk2, order 2");
  BOOST_TEST(figure->caption.ends_with(" Reference: closed form."), figure->caption);
  // Which one is said of each where they are not the same.
  StudyReport both = study;
  both.methods.push_back(study.methods[0]);
  both.methods[1].experiment = "b";
  both.methods[1].reference = "rkf78, order 8, at the step 0.025";
  BOOST_TEST(study_figure(both)->caption.ends_with(
                 " Reference of a, rk2: closed form. Reference of b, rk2: rkf78, order 8, at the "
                 "step 0.025."),
             study_figure(both)->caption);
  study.methods[0].rows = {{.step = 0.1, .seconds = 1e-3}};
  BOOST_TEST(!study_figure(study).has_value());
}

BOOST_AUTO_TEST_SUITE_END()
