#include "courant/reporting/section_figures.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "some_runs.hpp"

// Mistakes that these cases have to notice:
//  * a section is drawn in a coordinate that stands still on it
BOOST_AUTO_TEST_SUITE(section_figures)

using namespace courant;
using namespace courant::test;

namespace {

const Texts kNames = {"t", "x", "y", "p_x", "p_y"};

// What differs from one row to the next: 0 x, 1 y, 2 p_x, 3 p_y.
Run run_with(std::size_t occurrences, const std::vector<std::size_t>& differ) {
  Run run = table(kNames, 100, [](std::size_t c, double t) { return std::sin(t + double(c)); });
  run.summary.final = {{"x", 0.0}, {"y", 0.0}, {"p_x", 0.0}, {"p_y", 0.0}};
  std::vector<std::vector<double>> columns(kNames.size());
  for (std::size_t c = 0; c < kNames.size(); ++c)
    for (std::size_t k = 0; k < occurrences; ++k) {
      const bool differs = c == 0 || std::ranges::count(differ, c - 1) > 0;
      columns[c].push_back(differs ? 0.01 * double(k + c) : 0.25);
    }
  run.events.emplace("crossing", TrajectoryTable{kNames, columns});
  return run;
}

std::optional<Figure> section(const Run& run) { return section_figure(std::span(&run, 1)); }

}  // namespace

// On the section x = 0.25 that of y and its momentum, not that of what stands still there.
BOOST_AUTO_TEST_CASE(the_plane_of_a_coordinate_and_its_momentum) {
  const auto figure = section(run_with(20, {1, 2, 3}));
  BOOST_TEST_REQUIRE(figure.has_value());
  BOOST_TEST(figure->name == "section");
  BOOST_TEST_REQUIRE(figure->panels.size() == 1u);
  const plot::Panel& panel = figure->panels[0];
  BOOST_TEST(panel.x.label == "y");
  BOOST_TEST(panel.y.label == "p_y");
  BOOST_TEST(panel.scattered);
  BOOST_TEST_REQUIRE(panel.series.size() == 1u);
  BOOST_TEST(panel.series[0].x.size() == 20u);
  BOOST_TEST(panel.series[0].x[1] == 0.03);
  BOOST_TEST(figure->caption == "Poincaré section: (y, p_y) where crossing occurs, 20 times.");
}

BOOST_AUTO_TEST_CASE(or_of_two_coordinates) {
  const auto figure = section(run_with(20, {0, 1}));
  BOOST_TEST_REQUIRE(figure.has_value());
  BOOST_TEST(figure->panels[0].x.label == "x");
  BOOST_TEST(figure->panels[0].y.label == "y");
}

BOOST_AUTO_TEST_CASE(few_points_and_lines_are_no_section) {
  BOOST_TEST(!section(run_with(9, {1, 3})).has_value());
  BOOST_TEST(section(run_with(10, {1, 3})).has_value());
  BOOST_TEST(!section(run_with(20, {1})).has_value());
}

BOOST_AUTO_TEST_CASE(of_many_points_the_first) {
  const auto figure = section(run_with(5000, {1, 3}));
  BOOST_TEST(figure.value().panels[0].series[0].x.size() == 4000u);
}

BOOST_AUTO_TEST_SUITE_END()
