#include "courant/reporting/report_figures.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <set>

#include "../running/vortex_runs.hpp"

using namespace courant;
using courant::test::Path;
using Json = nlohmann::ordered_json;

namespace {

Run vortices(const std::string& name, const std::string& method, const Path& path) {
  std::vector<std::string> names = {"t"};
  for (const char* axis : {"x", "y"}) {
    for (int j = 0; j < 4; ++j) names.push_back(axis + std::string("[") + std::to_string(j) + "]");
  }
  names.emplace_back("H");
  std::vector<std::vector<double>> columns(names.size());
  for (std::size_t k = 0; k < path.size(); ++k) {
    columns[0].push_back(static_cast<double>(k));
    for (std::size_t i = 0; i < 8; ++i) columns[1 + i].push_back(path[k][i]);
    columns[9].push_back(test::energy(path[k]));
  }
  return {name, {names, columns}, read_run_summary(test::summary(path, method)), Json::object()};
}

Run table(const std::vector<std::string>& names, std::size_t rows,
          double (*value)(std::size_t column, double t)) {
  std::vector<std::vector<double>> columns(names.size());
  for (std::size_t c = 0; c < names.size(); ++c) {
    for (std::size_t k = 0; k < rows; ++k) {
      const double t = 0.05 * static_cast<double>(k);
      columns[c].push_back(c == 0 ? t : value(c, t));
    }
  }
  const RunSummary summary{.status = RunStatus::completed,
                           .system = "s",
                           .method = "m",
                           .steps = static_cast<long>(rows - 1)};
  return {"table", {names, columns}, summary, Json::object()};
}

double oscillation(std::size_t column, double t) {
  return std::cos(t + static_cast<double>(column));
}

std::vector<std::string> labels(const std::vector<plot::Series>& series) {
  std::vector<std::string> all;
  for (const auto& one : series) all.push_back(one.label);
  return all;
}

using Texts = std::vector<std::string>;

}  // namespace

BOOST_AUTO_TEST_SUITE(report_figures)

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
}

BOOST_AUTO_TEST_CASE(one_degree_of_freedom_has_a_phase_portrait) {
  const std::vector<Run> runs = {table({"t", "q", "p_q"}, 100, oscillation)};
  const auto figures = motion_figures(runs);
  BOOST_TEST_REQUIRE(figures.size() == 2);
  BOOST_TEST(figures[0].panels[0].x.label == "q");
  BOOST_TEST(figures[0].panels[0].y.label == "p_q");
  BOOST_TEST(figures[1].panels.size() == 2);
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

BOOST_AUTO_TEST_CASE(energy_of_all_runs_is_on_a_symmetric_log_axis) {
  const std::vector<Run> runs = {vortices("a", "rk2", test::rk2_path(300)),
                                 vortices("b", "discretize-first", test::two_step_path(300)),
                                 vortices("c", "constrain-first", test::one_step_path(300))};
  const auto figures = energy_figures(runs);
  // 4.1e-4 is less than a decade above 1.9e-4: there is nothing to zoom into.
  BOOST_TEST_REQUIRE(figures.size() == 1);
  const plot::Panel& panel = figures[0].panels[0];
  BOOST_CHECK(labels(panel.series) == (Texts{"rk2", "discretize-first", "constrain-first"}));
  BOOST_TEST(panel.y.scale->linear_zone().upper == 1e-5, boost::test_tools::tolerance(1e-12));
  for (const plot::Series& series : panel.series) BOOST_TEST(series.y.front() == 0);
  BOOST_TEST(std::abs(*std::ranges::max_element(panel.series[0].y) - 4.117e-4) < 1e-7);
}

BOOST_AUTO_TEST_CASE(methods_that_keep_the_energy_are_shown_again_without_those_that_do_not) {
  const std::vector<Run> runs = {vortices("a", "rk2", test::rk2_path(10'000)),
                                 vortices("b", "discretize-first", test::two_step_path(10'000)),
                                 vortices("c", "constrain-first", test::one_step_path(10'000))};
  const auto figures = energy_figures(runs);
  BOOST_TEST_REQUIRE(figures.size() == 2);
  BOOST_TEST(figures[0].panels[0].series.size() == 3);
  BOOST_TEST_REQUIRE(figures[1].panels.size() == 2);
  for (const plot::Panel& panel : figures[1].panels) {
    BOOST_CHECK(labels(panel.series) == (Texts{"discretize-first", "constrain-first"}));
    BOOST_TEST(panel.series[0].colour == 1);
  }
  BOOST_TEST(figures[1].panels[0].series[0].x.back() == 500);
  BOOST_TEST(figures[1].panels[1].series[0].x.back() == 10'000);
}

BOOST_AUTO_TEST_CASE(threshold_shows_the_smallest_curve) {
  const auto threshold = [](const std::vector<double>& sizes) {
    std::vector<plot::Series> series;
    for (const double size : sizes) series.push_back({"", {0, 1}, {0, -size}, 0});
    return symmetric_log_threshold(series);
  };
  const auto tolerance = boost::test_tools::tolerance(1e-12);
  BOOST_TEST(threshold({4e-4, 1.6e-4}) == 1e-5, tolerance);
  BOOST_TEST(threshold({1e-1, 3e-15}) == 1e-13, tolerance);
  BOOST_TEST(threshold({1e-1, 0}) == 1e-2, tolerance);
  BOOST_TEST(threshold({0}) == 1e-16, tolerance);
  BOOST_TEST(threshold({}) == 1e-16, tolerance);
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

BOOST_AUTO_TEST_CASE(runs_are_told_apart_by_method_or_else_by_folder) {
  const Path path = test::rk2_path(3);
  const std::vector<Run> runs = {vortices("a", "rk2", path), vortices("b", "midpoint", path),
                                 vortices("c", "rk2", path)};
  BOOST_CHECK(run_labels(runs) == (Texts{"rk2 — a", "midpoint", "rk2 — c"}));
}

BOOST_AUTO_TEST_SUITE_END()
