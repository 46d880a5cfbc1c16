#include "courant/reporting/space_figures.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/reporting/figure_file.hpp"
#include "some_runs.hpp"

using namespace courant;
using namespace courant::test;

namespace {

using Kind = SpatialPoints::Kind;

// A body that turns about the z axis: R, column by column of the table (1 to 9), and its momentum.
double turning(std::size_t c, double t) {
  const double entries[9] = {std::cos(t), -std::sin(t), 0, std::sin(t), std::cos(t), 0, 0, 0, 1};
  return c <= 9 ? entries[c - 1] : 0.1;
}

Texts rotation() {
  Texts names = {"t"};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      names.push_back("R[" + std::to_string(i) + "][" + std::to_string(j) + "]");
  for (int i = 0; i < 3; ++i) names.push_back("p_R[" + std::to_string(i) + "]");
  return names;
}

// A circle of latitude of radius 0.6 at height 0.8.
double latitude(std::size_t c, double t) {
  return c == 1 ? 0.6 * std::cos(t) : c == 2 ? 0.6 * std::sin(t) : 0.8;
}

double helix(std::size_t c, double t) { return c == 1 ? std::cos(t) : c == 2 ? std::sin(t) : t; }

}  // namespace

// Mistakes that these cases have to notice:
//  * any array of which something has the norm is a vector
BOOST_AUTO_TEST_SUITE(space_figures_test)

BOOST_AUTO_TEST_CASE(rotations_are_shown_by_the_axes_of_the_body) {
  const std::vector<Run> runs = {table(rotation(), 100, turning)};
  const auto all = spatial_points(runs[0]);
  BOOST_TEST_REQUIRE(all.size() == 1);
  BOOST_CHECK(all[0].kind == Kind::body_axes);
  BOOST_TEST_REQUIRE(all[0].points.size() == 3);
  BOOST_CHECK(
      (all[0].points[1].columns == std::array<std::string, 3>{"R[0][1]", "R[1][1]", "R[2][1]"}));
  // Nothing of it is a plane.
  const auto figures = motion_figures(runs);
  BOOST_TEST_REQUIRE(figures.size() == 1);
  BOOST_TEST(figures[0].name == "axes");
  BOOST_CHECK(labels(figures[0].panels[0].series) == (Texts{"R e₁", "R e₂", "R e₃"}));
  BOOST_TEST(figures[0].panels[0].space->radius == 1);
  BOOST_TEST(figures[0].panels[0].series[1].x[20] == -std::sin(1),
             boost::test_tools::tolerance(1e-12));
  // An array of nine that is no rotation is none.
  const Run other =
      table(rotation(), 100, [](std::size_t c, double t) { return turning(c, t) * 2; });
  for (const SpatialPoints& points : spatial_points(other))
    BOOST_CHECK(points.kind != Kind::body_axes);
}

BOOST_AUTO_TEST_CASE(points_of_one_length_are_on_a_sphere) {
  for (const Texts& names : {Texts{"t", "m[0]", "m[1]", "m[2]"}, Texts{"t", "x", "y", "z"},
                             Texts{"t", "x[4]", "y[4]", "z[4]"}}) {
    const auto all = spatial_points(table(names, 100, latitude));
    BOOST_TEST_REQUIRE(all.size() == 1);
    BOOST_CHECK(all[0].kind == Kind::sphere);
    BOOST_TEST(all[0].radius == 1, boost::test_tools::tolerance(1e-12));
  }
  // Several on one sphere are in one picture; momenta are in none.
  const Run several =
      table({"t", "x[0][0]", "x[0][1]", "x[0][2]", "x[1][0]", "x[1][1]", "x[1][2]", "p_x[0][0]",
             "p_x[0][1]", "p_x[0][2]"},
            100, [](std::size_t c, double t) { return latitude((c - 1) % 3 + 1, t); });
  BOOST_TEST_REQUIRE(spatial_points(several).size() == 1);
  BOOST_TEST(spatial_points(several)[0].points.size() == 2);
  BOOST_TEST(motion_figures(std::vector<Run>{several}).size() == 1);
}

BOOST_AUTO_TEST_CASE(places_in_space_are_curves_and_coordinates_are_not) {
  for (const Texts& names :
       {Texts{"t", "r[0]", "r[1]", "r[2]"}, Texts{"t", "x", "y", "z"}, Texts{"t", "x1", "y1", "z1"},
        Texts{"t", "q[7][0]", "q[7][1]", "q[7][2]"}}) {
    const auto all = spatial_points(table(names, 100, helix));
    BOOST_TEST_REQUIRE(all.size() == 1);
    BOOST_CHECK(all[0].kind == Kind::space);
  }
  Run generalised = table({"t", "q[0]", "q[1]", "q[2]"}, 100, helix);
  BOOST_TEST(spatial_points(generalised).empty());
  // Unless the formulas of the system take them for a vector.
  const auto with_potential = [&](const char* potential) {
    generalised.experiment = {{"system", {{"potential", potential}}}};
    return spatial_points(generalised).size();
  };
  BOOST_TEST(with_potential("k*(norm(q) - l)^2") == 1u);
  BOOST_TEST(with_potential("dot(e, q)") == 1u);
  BOOST_TEST(with_potential("norm(eq) + q[0]") == 0u);
  BOOST_TEST(spatial_points(table({"t", "r[0]", "r[1]", "r[2]", "r[3]"}, 100, helix)).empty());
  // Three bodies in a plane are no point of space.
  BOOST_TEST(
      spatial_points(table({"t", "x[0]", "x[1]", "x[2]", "y[0]", "y[1]", "y[2]"}, 100, helix))
          .empty());
  // Neither is what stays in a plane z = constant.
  const auto flat = [](std::size_t c, double t) { return c == 3 ? 0.25 : t * helix(c, t); };
  const std::vector<Run> planar = {table({"t", "r[0][0]", "r[0][1]", "r[0][2]"}, 100, flat)};
  BOOST_TEST(spatial_points(planar[0]).empty());
  BOOST_TEST(motion_figures(planar)[0].name == "paths");
}

BOOST_AUTO_TEST_CASE(each_run_has_a_picture) {
  const Texts names = {"t", "r[0]", "r[1]", "r[2]"};
  const std::vector<Run> runs = {table(names, 100, helix), table({"t", "a"}, 10, helix),
                                 table(names, 50, helix)};
  const auto figures = space_figures(runs);
  BOOST_TEST_REQUIRE(figures.size() == 1);
  BOOST_TEST(figures[0].panels.size() == 2);
  BOOST_TEST(!figures[0].panels[0].heading.empty());
  BOOST_TEST(figures[0].panels[0].series[0].t.back() == 0.05 * 99,
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST(figure_csv(figures[0]).starts_with("m — table: r[0]") == true);
  BOOST_TEST(figure_csv(figures[0]).find("r[2]") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(rows_far_apart_are_points) {
  const Texts names = {"t", "x", "y", "z"};
  const auto fast = [](std::size_t c, double t) { return latitude(c, 40 * t); };
  BOOST_TEST(space_figures(std::vector<Run>{table(names, 40, fast)})[0].panels[0].points);
  BOOST_TEST(!space_figures(std::vector<Run>{table(names, 40, latitude)})[0].panels[0].points);
}

BOOST_AUTO_TEST_CASE(only_the_legible_beginning_is_drawn) {
  // Forty times the width of the circle is 80 / (2π) turns.
  const Run run = table({"t", "x", "y", "z"}, 10'000, latitude);
  const auto figure = space_figures(std::vector<Run>{run})[0];
  const double turns = figure.panels[0].series[0].t.back() / 6.283185307179586;
  BOOST_TEST(turns > 12.0);
  BOOST_TEST(turns < 18.0);
  BOOST_TEST(figure.caption.find("the beginning") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(short_and_broken_runs_have_no_trouble) {
  const Texts names = {"t", "x", "y", "z"};
  BOOST_TEST(space_figures({}).empty());
  const Run none{"none", {names, {{}, {}, {}, {}}}, {}, Json::object()};
  BOOST_TEST(space_figures(std::vector<Run>{none}).empty());
  const auto broken = [](std::size_t, double) { return std::nan(""); };
  BOOST_CHECK_NO_THROW(space_figures(std::vector<Run>{table(names, 100, broken)}));
  BOOST_CHECK_NO_THROW(space_figures(std::vector<Run>{table(rotation(), 100, broken)}));
  BOOST_CHECK_NO_THROW(space_figures(std::vector<Run>{table(names, 1, helix)}));
}

BOOST_AUTO_TEST_SUITE_END()
