#include "courant/plotting/space.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "courant/plotting/figure.hpp"
#include "parsed_markup.hpp"

using namespace courant::plot;
using namespace courant::test;

namespace {

// A great circle through the poles of the x and z axes.
Panel great_circle(int rows) {
  Series series{"a", {}, {}, 2, {}, {}};
  for (int i = 0; i < rows; ++i) {
    const double angle = 2 * std::numbers::pi * i / (rows - 1);
    series.x.push_back(2 * std::cos(angle));
    series.y.push_back(0);
    series.z.push_back(2 * std::sin(angle));
    series.t.push_back(i);
  }
  Panel panel;
  panel.space = Space{"z", 2};
  panel.x.label = "x";
  panel.y.label = "y";
  panel.width = 400;
  panel.height = 400;
  panel.endpoints = true;
  panel.series = {series};
  return panel;
}

std::vector<double> numbers(const std::string& text) {
  std::istringstream stream(text);
  std::vector<double> all;
  for (double number; stream >> number;) all.push_back(number);
  return all;
}

// The formula of space.hpp, by another way: turned about z, then about y, then seen along x.
std::pair<double, double> seen(const std::vector<double>& space, const std::vector<double>& camera,
                               std::array<double, 3> p) {
  for (std::size_t i = 0; i < 3; ++i) p[i] = (p[i] - space[i]) / space[3];
  const auto turned = [](double a, double b, double angle) {
    return std::pair(a * std::cos(angle) + b * std::sin(angle),
                     b * std::cos(angle) - a * std::sin(angle));
  };
  const auto [x, right] = turned(p[0], p[1], camera[0]);
  const auto [toward, up] = turned(x, p[2], camera[1]);
  const double w = space[7] == 0 ? 1 : space[7] / (space[7] - toward);
  return {space[4] + space[6] * w * right, space[5] - space[6] * w * up};
}

}  // namespace

BOOST_AUTO_TEST_SUITE(space)

BOOST_AUTO_TEST_CASE(points_are_where_the_attributes_say) {
  for (const double radius : {2.0, 0.0}) {
    Panel panel = great_circle(361);
    panel.space->radius = radius;
    for (double& x : panel.series[0].x) x += radius == 0 ? 5 : 0;
    const Tree drawing = parsed(draw(panel, 1000).str());
    const Tree group = find(drawing, "g", "panel").at(0);
    const auto space = numbers(attribute(group, "data-space"));
    const auto camera = numbers(attribute(group, "data-camera"));
    BOOST_TEST_REQUIRE(space.size() == 8);
    BOOST_TEST_REQUIRE(camera.size() == 2);
    BOOST_TEST(space[0] == (radius == 0 ? 5 : 0));
    const Series& series = panel.series[0];
    // Every vertex is a row's, and both halves are there on a sphere.
    std::size_t vertices_found = 0;
    for (const Tree& path : find(find(drawing, "g", "series").at(0), "path")) {
      for (const auto& [x, y] : vertices(attribute(path, "d"))) {
        ++vertices_found;
        double least = 1e9;
        for (std::size_t row = 0; row < series.x.size(); ++row) {
          const auto [px, py] = seen(space, camera, {series.x[row], series.y[row], series.z[row]});
          least = std::min(least, std::hypot(px - x, py - y));
        }
        BOOST_TEST(least < 0.1);
      }
    }
    BOOST_TEST(vertices_found > 50);
    // It starts and ends in the same place.
    const auto dots = find(find(drawing, "g", "endpoints").at(0), "circle");
    BOOST_TEST_REQUIRE(dots.size() == 2);
    BOOST_TEST(attribute(dots[0], "cx") == attribute(dots[1], "cx"));
  }
}

BOOST_AUTO_TEST_CASE(a_sphere_has_a_far_side) {
  const Tree drawing = parsed(draw(great_circle(361)).str());
  const auto paths = find(find(drawing, "g", "series").at(0), "path");
  BOOST_TEST_REQUIRE(paths.size() == 2);
  BOOST_TEST(attribute(paths[0], "stroke-opacity") == "0.4");
  // Half of a great circle is in front, half is not.
  const auto length = [](const Tree& path) {
    const auto all = vertices(attribute(path, "d"));
    double sum = 0;
    for (std::size_t i = 1; i < all.size(); ++i) {
      const double step =
          std::hypot(all[i].first - all[i - 1].first, all[i].second - all[i - 1].second);
      if (step < 30) sum += step;  // longer ones lead from part to part
    }
    return sum;
  };
  BOOST_TEST(std::abs(length(paths[0]) / length(paths[1]) - 1) < 0.05);
  // Outline and wires behind and in front; three names.
  const Tree scaffold = find(drawing, "g", "scaffold").at(0);
  BOOST_TEST(find(scaffold, "circle").size() == 1);
  BOOST_TEST(find(scaffold, "path").size() == 2);
  BOOST_TEST(find(scaffold, "text").size() == 3);
}

BOOST_AUTO_TEST_CASE(everything_is_inside_the_picture) {
  for (const double radius : {2.0, 0.0}) {
    Panel panel = great_circle(100);
    panel.space->radius = radius;
    const Tree drawing = parsed(draw(panel).str());
    for (const Tree& path : find(drawing, "path")) {
      for (const auto& [x, y] : vertices(attribute(path, "d"))) {
        BOOST_TEST((x >= 0 && x <= panel.width));
        BOOST_TEST((y >= 0 && y <= panel.height));
      }
    }
    BOOST_TEST(drawn_height(panel) == panel.height);
  }
}

BOOST_AUTO_TEST_CASE(numbers_go_along_where_they_are_asked_for) {
  const Tree alone = parsed(draw(great_circle(100)).str());
  BOOST_TEST(draw(great_circle(100)).str().find("data-") == std::string::npos);
  BOOST_TEST(find(alone, "g", "panel").empty());
  const Tree series = find(parsed(draw(great_circle(100), 3).str()), "g", "series").at(0);
  BOOST_TEST(attribute(series, "data-rows") == "100");
  for (const std::string name : {"data-x", "data-y", "data-z"})
    BOOST_TEST(attribute(series, name).size() == 16);
}

BOOST_AUTO_TEST_CASE(points_instead_of_a_line) {
  Panel panel = great_circle(10);
  panel.points = true;
  std::size_t points = 0;
  for (const Tree& path : find(find(parsed(draw(panel).str()), "g", "series").at(0), "path")) {
    const std::string d = attribute(path, "d");
    BOOST_TEST(d.find('L') == std::string::npos);
    BOOST_TEST(attribute(path, "stroke-linecap") == "round");
    points += static_cast<std::size_t>(std::ranges::count(d, 'M'));
  }
  BOOST_TEST(points == 10);
}

BOOST_AUTO_TEST_CASE(odd_curves_are_drawn) {
  Panel panel = great_circle(10);
  panel.series[0].y[4] = std::nan("");
  const std::string text = draw(panel).str();
  BOOST_TEST(text.find("nan") == std::string::npos);
  for (const double radius : {1.0, 0.0}) {
    panel.space->radius = radius;
    panel.series = {{"none", {}, {}, 0}, {"one", {1}, {1}, 1, {0}, {1}}};
    const std::string few = draw(panel, 5).str();
    BOOST_TEST(few.find("nan") == std::string::npos);
    BOOST_TEST(find(parsed(few), "g", "series").size() == 2);
  }
}

BOOST_AUTO_TEST_SUITE_END()
