#include "courant/reporting/report_figures.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <set>

#include "some_runs.hpp"

// Mistakes that these cases have to notice:
//  * where no beginning is legible all rows are drawn
//  * a section is drawn over a coordinate that is the same at all of its points
//    (reporting/section_figures.cpp)
BOOST_AUTO_TEST_SUITE(report_figures)

using namespace courant;
using courant::test::labels;
using courant::test::Path;
using courant::test::table;
using courant::test::Texts;
using courant::test::vortices;

namespace {

double oscillation(std::size_t column, double t) {
  return std::cos(t + static_cast<double>(column));
}

std::vector<double> columns_of(const Run& run, const std::string& name) {
  const auto values = run.events.at("pass").column(name);
  return {values.begin(), values.end()};
}

}  // namespace

BOOST_AUTO_TEST_CASE(planar_bodies_are_found_by_their_names) {
  const auto bodies = [](const Texts& names) { return planar_bodies(names); };
  using Bodies = std::vector<PlanarBody>;
  BOOST_CHECK(bodies({"x[0]", "x[1]", "y[0]", "y[1]"}) ==
              (Bodies{{"x[0]", "y[0]"}, {"x[1]", "y[1]"}}));
  BOOST_CHECK(bodies({"x", "y", "p_x", "p_y"}) == (Bodies{{"x", "y"}}));
  BOOST_CHECK(bodies({"x1", "y1", "x2", "y2"}) == (Bodies{{"x1", "y1"}, {"x2", "y2"}}));
  BOOST_CHECK(bodies({"r[0][0]", "r[0][1]", "r[0][2]", "r[1][0]", "r[1][1]", "r[1][2]", "p_r[0][0]",
                      "p_r[0][1]"}) == (Bodies{{"r[0][0]", "r[0][1]"}, {"r[1][0]", "r[1][1]"}}));
  BOOST_CHECK(bodies({"r[0]", "r[1]", "p_r[0]", "p_r[1]"}) == (Bodies{{"r[0]", "r[1]"}}));
  BOOST_TEST(bodies({"theta", "phi", "p_theta", "p_phi"}).empty());
  BOOST_TEST(bodies({"x", "p_x", "z"}).empty());
  BOOST_TEST(bodies({"q[0]", "q[1]", "q[2]"}).empty());
}

BOOST_AUTO_TEST_CASE(vortices_are_drawn_as_in_figure_1) {
  const std::vector<Run> runs = {vortices("a", "rk2", test::rk2_path(300)),
                                 vortices("b", "constrain-first", test::one_step_path(300))};
  const auto figures = motion_figures(runs);
  BOOST_TEST_REQUIRE(figures.size() == 1);
  BOOST_TEST_REQUIRE(figures[0].panels.size() == 2);
  for (const plot::Panel& panel : figures[0].panels) {
    BOOST_TEST(panel.equal_aspect);
    BOOST_TEST(panel.endpoints);
    BOOST_CHECK(labels(panel.series) ==
                (Texts{"(x[0], y[0])", "(x[1], y[1])", "(x[2], y[2])", "(x[3], y[3])"}));
    BOOST_TEST(panel.series[0].x.size() == 301);
    BOOST_TEST(panel.x.interval.upper == figures[0].panels[0].x.interval.upper);
  }
  BOOST_TEST(figures[0].panels[1].heading == "constrain-first");
  BOOST_TEST(figures[0].legend.size() == 4);
}

BOOST_AUTO_TEST_CASE(only_the_legible_beginning_of_a_long_path_is_drawn) {
  const Run run = vortices("a", "constrain-first", test::one_step_path(3000));
  const auto bodies = planar_bodies(run.coordinates());
  const std::size_t rows = legible_rows(run.trajectory, bodies);
  BOOST_TEST(rows > 400);
  BOOST_TEST(rows < 700);
  const auto figure = motion_figures(std::vector<Run>{run})[0];
  BOOST_TEST(figure.panels[0].series[0].x.size() == rows);
  BOOST_TEST(figure.caption.find("the beginning, t ≤ " + std::to_string(rows - 1)) !=
             std::string::npos);
  // A circle is run through 40 √8 / (2π) = 18 times; a straight line is shown whole.
  const Run circle = table({"t", "x", "y"}, 10'000, [](std::size_t c, double t) {
    return c == 1 ? std::cos(t) : std::sin(t);
  });
  const std::vector<PlanarBody> body = {{"x", "y"}};
  BOOST_TEST(std::abs(0.05 * static_cast<double>(legible_rows(circle.trajectory, body)) -
                      40 * std::sqrt(8)) < 0.2);
  const Run straight =
      table({"t", "x", "y"}, 10'000, [](std::size_t c, double t) { return c == 1 ? t : 0; });
  BOOST_TEST(legible_rows(straight.trajectory, body) == 10'000);
  // A fast motion across a slow one fills its narrow box before that is wide: the whole box counts.
  const Run rough = table({"t", "x", "y"}, 10'000, [](std::size_t c, double t) {
    return c == 1 ? (std::lround(20 * t) % 2 == 0 ? 0.1 : 0.0) : 1e-3 * t;
  });
  BOOST_TEST(std::abs(0.1 * static_cast<double>(legible_rows(rough.trajectory, body)) -
                      40 * std::hypot(0.1, 0.5)) < 0.3);
}

BOOST_AUTO_TEST_CASE(one_degree_of_freedom_has_a_phase_portrait) {
  const std::vector<Run> runs = {table({"t", "q", "p_q"}, 100, oscillation)};
  const auto figures = motion_figures(runs);
  BOOST_TEST_REQUIRE(figures.size() == 2);
  BOOST_TEST(figures[0].panels[0].x.label == "q");
  BOOST_TEST(figures[0].panels[0].y.label == "p_q");
  BOOST_TEST(figures[1].panels.size() == 2);
}

// As of a circuit of three elements that store energy.
BOOST_AUTO_TEST_CASE(three_coordinates_have_a_path_and_time_series) {
  const std::vector<Run> runs = {table({"t", "x", "y", "z"}, 100, [](std::size_t c, double t) {
    return c == 1 ? std::cos(t) : c == 2 ? std::sin(t) : t;
  })};
  const auto figures = motion_figures(runs);
  BOOST_TEST_REQUIRE(figures.size() == 2u);
  BOOST_TEST(figures[0].name == "space");
  BOOST_TEST(figures[1].name == "coordinates");
  BOOST_TEST(figures[1].panels.size() == 3u);
}

BOOST_AUTO_TEST_CASE(any_other_system_has_time_series) {
  const std::vector<Run> few = {table({"t", "a", "b", "c"}, 100, oscillation)};
  BOOST_TEST_REQUIRE(motion_figures(few).size() == 1);
  BOOST_TEST(motion_figures(few)[0].panels.size() == 3);
  Texts names = {"t"};
  for (int i = 0; i < 30; ++i) names.push_back("a[" + std::to_string(i) + "]");
  const std::vector<Run> many = {table(names, 10, oscillation)};
  BOOST_TEST(motion_figures(many)[0].panels.size() == 12);
  BOOST_TEST(motion_figures(many)[0].caption.find("The first 12 of 30.") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(constraints_are_shown_by_their_greatest_violation) {
  const std::vector<Run> runs = {
      table({"t", "q", "constraint[0]", "constraint[1]"}, 50, [](std::size_t c, double t) {
        return c == 2 ? 1e-12 * t : c == 3 ? -2e-12 : 0;
      })};
  const auto figure = constraint_figure(runs);
  BOOST_TEST_REQUIRE(figure.has_value());
  BOOST_TEST(figure->panels[0].series[0].y.front() == 2e-12);
  BOOST_TEST(figure->panels[0].series[0].y.back() == 1e-12 * 2.45,
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST(!constraint_figure(std::vector<Run>{table({"t", "q"}, 5, oscillation)}).has_value());
}

// x does not differ where it is 0, so that (y, p_y) is the plane.
BOOST_AUTO_TEST_CASE(events_are_a_section) {
  Run run = table({"t", "x", "y", "p_x", "p_y"}, 60,
                  [](std::size_t c, double t) { return std::sin(static_cast<double>(c) + 9 * t); });
  std::vector<std::vector<double>> columns(5);
  for (int k = 0; k < 12; ++k) {
    const double t = 0.2 * k;
    const double row[] = {t, 1e-17 * k, std::cos(t), std::sin(t), std::sin(2 * t)};
    for (std::size_t c = 0; c < 5; ++c) columns[c].push_back(row[c]);
  }
  run.events.emplace("pass", TrajectoryTable({"t", "x", "y", "p_x", "p_y"}, columns));
  for (auto& column : columns) column.resize(9);
  run.events.emplace("seldom", TrajectoryTable({"t", "x", "y", "p_x", "p_y"}, columns));
  const auto figures = motion_figures(std::span(&run, 1));
  const Figure& section = figures.back();
  BOOST_TEST(section.name == "section");
  BOOST_TEST_REQUIRE(section.panels.size() == 1U);
  BOOST_TEST(section.panels[0].scattered);
  BOOST_TEST(section.panels[0].series[0].x == columns_of(run, "y"),
             boost::test_tools::per_element());
  BOOST_TEST(section.panels[0].series[0].y == columns_of(run, "p_y"),
             boost::test_tools::per_element());
  BOOST_TEST(section.caption == "Poincaré section: (y, p_y) where pass occurs, 12 times.");
  run.events.erase("pass");
  BOOST_TEST(motion_figures(std::span(&run, 1)).back().name != "section");
}

BOOST_AUTO_TEST_CASE(axes_have_labels_and_units) {
  Run run = table({"t", "q", "p_q", "r[0]"}, 5, oscillation);
  run.experiment = {{"output",
                     {{"units", {{"t", "s"}, {"q", "m"}, {"r", "km"}}},
                      {"labels", {{"q", "distance"}, {"p_q", "momentum"}}}}}};
  const std::vector<Run> runs = {table({"t", "a"}, 5, oscillation), run};
  BOOST_TEST(axis_label(runs, "q") == "distance [m]");
  BOOST_TEST(axis_label(runs, "p_q") == "momentum");
  BOOST_TEST(axis_label(runs, "r[0]") == "r[0] [km]");
  BOOST_TEST(axis_label(runs, "a") == "a");
  const auto figures = motion_figures(std::vector<Run>{run});
  BOOST_TEST(figures[0].panels[0].x.label == "t [s]");
  BOOST_TEST(figures[0].panels[0].y.label == "distance [m]");
}

BOOST_AUTO_TEST_CASE(every_figure_has_a_name_of_its_own) {
  const std::vector<Run> runs = {
      table({"t", "q", "p_q", "H", "constraint[0]"}, 50, oscillation),
      table({"t", "q", "p_q", "H", "constraint[0]"}, 50,
            [](std::size_t c, double t) { return 1e-6 * oscillation(c, t); })};
  std::vector<std::string> names;
  for (const Figure& figure : all_figures(runs)) names.push_back(figure.name);
  BOOST_CHECK(names == (Texts{"phase", "coordinates", "energy", "energy-detail", "constraints"}));
}

BOOST_AUTO_TEST_CASE(runs_are_told_apart_by_method_or_else_by_folder) {
  const Path path = test::rk2_path(3);
  const std::vector<Run> runs = {vortices("a", "rk2", path), vortices("b", "midpoint", path),
                                 vortices("c", "rk2", path)};
  BOOST_CHECK(run_labels(runs) == (Texts{"rk2 — a", "midpoint", "rk2 — c"}));
}

// A crank (0, A) and a coupler (A, B) whose end slides on a line: two rods, and none from the origin to B, from where B moves away.
// Without constraints on places there are none, whatever the distances are.
BOOST_AUTO_TEST_CASE(rods_stand_where_distances_are_kept) {
  Run run =
      test::table({"t", "a", "s", "p_a", "p_s", "A_x", "A_y", "B_x", "B_y"}, 100,
                  [](std::size_t column, double t) {
                    const double slide = std::cos(t) + std::sqrt(9 - std::sin(t) * std::sin(t));
                    const double values[] = {t, t, slide, 0, 0, std::cos(t), std::sin(t), slide, 0};
                    return values[column];
                  });
  for (const char* name : {"A_x", "A_y", "B_x", "B_y"})
    run.summary.observables.push_back({name, {}});
  BOOST_TEST(motion_figures(std::span(&run, 1)).front().name == "coordinates");
  run.experiment["system"] = {{"type", "mechanical"}, {"holonomic", {"…"}}};
  const std::vector<Figure> figures = motion_figures(std::span(&run, 1));
  BOOST_TEST_REQUIRE(figures.front().name == "paths");
  const plot::Panel& panel = figures.front().panels.front();
  BOOST_TEST_REQUIRE(panel.rods.size() == 2u);
  BOOST_TEST(panel.rods[0].from == 0u);
  BOOST_TEST(!panel.rods[0].to.has_value());
  BOOST_TEST(panel.rods[1].from == 0u);
  BOOST_TEST(panel.rods[1].to.value() == 1u);
  BOOST_TEST(plot::draw(panel, 100).str().find("data-rods=\"0- 0-1\"") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
