#include "courant/plotting/figure.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "courant/plotting/drawing.hpp"
#include "parsed_markup.hpp"

// Mistakes that these cases have to notice:
//  * a rough path has a vertex for each of its rows
//  * points of a section are joined by lines
//  * Greek letters are written out (plotting/drawing.cpp)
BOOST_AUTO_TEST_SUITE(figure)

using namespace courant::plot;
using namespace courant::test;

namespace {

Series sampled(const std::string& label, int rows, double (*f)(double), std::size_t colour = 0) {
  Series series{label, {}, {}, colour};
  for (int i = 0; i < rows; ++i) {
    series.x.push_back(static_cast<double>(i) / (rows - 1));
    series.y.push_back(f(series.x.back()));
  }
  return series;
}

std::string only_path(const Tree& drawing, const std::string& style) {
  const auto paths = find(drawing, "path", style);
  BOOST_TEST_REQUIRE(paths.size() == 1);
  return attribute(paths[0], "d");
}

// The pixel of the axis tick that has this label, along x or y.
double tick_pixel(const Tree& drawing, const std::string& label, const std::string& anchor) {
  for (const Tree& text : find(drawing, "text")) {
    if (text.data() == label && attribute(text, "text-anchor") == anchor) {
      return anchor == "middle" ? text.get<double>("<xmlattr>.x")
                                : text.get<double>("<xmlattr>.y") - 4;
    }
  }
  BOOST_FAIL("no tick " << label);
  return 0;
}

}  // namespace

BOOST_AUTO_TEST_CASE(has_exactly_the_series_it_was_given) {
  Panel panel;
  panel.title = "Lines";
  panel.series = {sampled(
                      "first <1>", 5, [](double x) { return x; }, 0),
                  sampled(
                      "second & last", 5, [](double x) { return 1 - x; }, 4)};
  const Tree drawing = parsed(draw(panel).str());
  const auto groups = find(drawing, "g", "series");
  BOOST_TEST_REQUIRE(groups.size() == 2);
  BOOST_TEST(groups[0].get<std::string>("title") == "first <1>");
  BOOST_TEST(groups[1].get<std::string>("title") == "second & last");
  BOOST_TEST(attribute(groups[0], "class") == "series c0");
  BOOST_TEST(attribute(groups[1], "class") == "series c4");
  BOOST_TEST(find(drawing, "path").size() == 2);
  BOOST_TEST(drawing.get<std::string>("svg.title") == "Lines");
}

BOOST_AUTO_TEST_CASE(curve_passes_where_its_axes_say) {
  Panel panel;
  panel.x.label = "t";
  panel.y.scale = std::make_shared<SymmetricLogScale>(1e-3);
  panel.series = {{"corner", {0, 1, 2}, {-1e-3, 1e-1, 0}, 0}};
  const Tree drawing = parsed(draw(panel).str());
  const auto path = vertices(only_path(drawing, "line"));
  BOOST_TEST_REQUIRE(path.size() == 3);
  BOOST_TEST(std::abs(path[1].first - tick_pixel(drawing, "1.0", "middle")) < 0.1);
  BOOST_TEST(std::abs(path[2].first - tick_pixel(drawing, "2.0", "middle")) < 0.1);
  BOOST_TEST(std::abs(path[0].second - tick_pixel(drawing, "−10⁻³", "end")) < 0.1);
  BOOST_TEST(std::abs(path[1].second - tick_pixel(drawing, "10⁻¹", "end")) < 0.1);
  BOOST_TEST(std::abs(path[2].second - tick_pixel(drawing, "0", "end")) < 0.1);
  // The linear zone is shaded, from -10⁻³ to 10⁻³.
  const auto zone = find(drawing, "rect", "linear-zone");
  BOOST_TEST_REQUIRE(zone.size() == 1);
  BOOST_TEST(std::abs(zone[0].get<double>("<xmlattr>.y") - tick_pixel(drawing, "10⁻³", "end")) <
             0.1);
}

BOOST_AUTO_TEST_CASE(circle_is_round_with_equal_aspect) {
  Panel panel;
  panel.equal_aspect = panel.endpoints = true;
  Series circle{"circle", {}, {}, 0};
  for (int i = 0; i <= 360; ++i) {
    circle.x.push_back(5 + 3 * std::cos(i * std::numbers::pi / 180));
    circle.y.push_back(3 * std::sin(i * std::numbers::pi / 180));
  }
  for (const double squeeze : {1.0, 0.05, 20.0}) {
    panel.series = {circle};
    for (double& y : panel.series[0].y) y *= squeeze;
    const Tree drawing = parsed(draw(panel).str());
    Interval x, y;
    for (const auto& [px, py] : vertices(only_path(drawing, "line"))) x.include(px), y.include(py);
    BOOST_TEST(std::abs(y.length() - squeeze * x.length()) < 0.5 * std::max(1.0, squeeze));
    BOOST_TEST(x.lower >= 0);
    BOOST_TEST(y.upper <= drawing.get<double>("svg.<xmlattr>.height"));
    BOOST_TEST(find(drawing, "circle", "start").size() == 1);
    BOOST_TEST(find(drawing, "circle", "end").size() == 1);
  }
}

BOOST_AUTO_TEST_CASE(many_rows_become_a_small_band_that_keeps_the_extrema) {
  Panel panel;
  Series series = sampled("wave", 200'001, [](double x) { return std::sin(40'000 * x); });
  series.y[123'456] = 4;
  panel.series = {series};
  const std::string text = draw(panel).str();
  BOOST_TEST(text.size() < 30'000);
  const Tree drawing = parsed(text);
  BOOST_TEST(find(drawing, "path", "line").empty());
  double highest = 1e9;
  for (const auto& [x, y] : vertices(only_path(drawing, "band"))) highest = std::min(highest, y);
  BOOST_TEST(std::abs(highest - tick_pixel(drawing, "4", "end")) < 0.1);
}

BOOST_AUTO_TEST_CASE(rows_that_are_not_finite_are_gaps) {
  Panel panel;
  panel.series = {{"broken", {0, 1, 2, 3, 4}, {0, 1, std::nan(""), 3, INFINITY}, 0}};
  const std::string data = only_path(parsed(draw(panel).str()), "line");
  BOOST_TEST(std::count(data.begin(), data.end(), 'M') == 2);
  BOOST_TEST(vertices(data).size() == 3);
}

BOOST_AUTO_TEST_CASE(nothing_to_draw_is_an_empty_frame) {
  Panel panel;
  panel.endpoints = true;
  panel.series = {
      {"empty", {}, {}, 0}, {"one row", {1}, {2}, 1}, {"nowhere", {1}, {std::nan("")}, 2}};
  const Tree drawing = parsed(draw(panel).str());
  BOOST_TEST(find(drawing, "g", "series").size() == 3);
  BOOST_TEST(find(drawing, "circle", "start").size() == 1);
  panel.series.clear();
  BOOST_TEST(find(parsed(draw(panel).str()), "g", "axis").size() == 2);
}

BOOST_AUTO_TEST_CASE(axis_labels_are_set_as_mathematics) {
  Panel panel;
  panel.x.label = "p_theta[0] of q";
  panel.y.label = "energy <x_> a_1";
  const Tree drawing = parsed(draw(panel).str());
  std::vector<std::string> italics, subscripts;
  for (const Tree& span : find(drawing, "tspan")) {
    if (attribute(span, "dy") == "3") {
      subscripts.push_back(span.data());
    } else if (attribute(span, "font-style") == "italic") {
      italics.push_back(span.data());
    }
  }
  BOOST_TEST(subscripts == (std::vector<std::string>{"1", "θ"}), boost::test_tools::per_element());
  BOOST_TEST(italics == (std::vector<std::string>{"x", "a", "p", "q"}),
             boost::test_tools::per_element());
  panel.x.label = "phi_L1 (Wb)";
  const auto flux = find(parsed(draw(panel).str()), "tspan");
  BOOST_TEST(std::ranges::any_of(flux, [](const Tree& span) { return span.data() == "φ"; }));
  BOOST_TEST(std::ranges::any_of(flux, [](const Tree& span) { return span.data() == "L1"; }));
}

BOOST_AUTO_TEST_CASE(legend_names_what_it_is_given) {
  const std::vector<LegendEntry> entries = {{"<b>", 0}, {"second", 3}};
  const auto items = find(parsed(legend(entries).str()), "li");
  BOOST_TEST_REQUIRE(items.size() == 2);
  BOOST_TEST(items[0].data().find("<b>") != std::string::npos);
  BOOST_TEST(attribute(items[1], "class") == "c3");
}

// No line leads from one to the next.
BOOST_AUTO_TEST_CASE(rows_that_are_no_curve_are_dots) {
  Panel panel;
  panel.series = {{"a", {1, 3, std::nan(""), 2}, {4, 5, 6, 7}, 0, {0, 1, 2, 3}}};
  panel.scattered = true;
  for (const std::size_t rows : {std::size_t{0}, std::size_t{100}}) {
    const auto paths = find(parsed(draw(panel, rows).str()), "path", "dots");
    BOOST_TEST_REQUIRE(paths.size() == 1U);
    const std::string d = attribute(paths[0], "d");
    BOOST_TEST(std::ranges::count(d, 'M') == 3);
    BOOST_TEST(std::ranges::count(d, 'Z') == 3);
    BOOST_TEST(std::ranges::count(d, 'L') == 0, d);
    BOOST_TEST(attribute(paths[0], "stroke-linecap") == "round");
  }
}

BOOST_AUTO_TEST_CASE(points_are_drawn_where_there_are_numbers) {
  Panel panel;
  panel.series = {{"a", {1e-3, 1e-2, 1e-1, 1}, {1e-6, std::nan(""), 1e-2, 1}, 0}};
  panel.x.scale = panel.y.scale = std::make_shared<LogScale>();
  panel.points = true;
  const Tree drawing = parsed(draw(panel).str());
  const auto dots = find(drawing, "circle");
  BOOST_TEST_REQUIRE(dots.size() == 3u);
  // Equal ratios are equal distances.
  const auto at = [&](std::size_t i) { return std::stod(attribute(dots[i], "cx")); };
  BOOST_TEST(std::abs((at(2) - at(1)) * 2 - (at(1) - at(0))) < 0.1);
  BOOST_TEST(std::abs(drawn_height(panel) - panel.height) < 1e-9);
}

BOOST_AUTO_TEST_CASE(numbers_go_along_where_they_are_asked_for) {
  Panel panel;
  panel.series = {{"a", {0, 1}, {0, 1}, 0}};
  BOOST_TEST(draw(panel).str().find("data-") == std::string::npos);
  const Tree drawing = parsed(draw(panel, 10).str());
  BOOST_TEST(attribute(find(drawing, "g", "series").at(0), "data-y") == "AAAAAAAAgD8=");
  BOOST_TEST(attribute(find(drawing, "g", "panel").at(0), "data-area") == "62 26 702 278");
  BOOST_TEST(attribute(find(drawing, "g", "panel").at(0), "data-view") == "-0.03 1.03 -0.03 1.03");
  BOOST_TEST(attribute(find(drawing, "g", "panel").at(0), "data-origin") == "0 0");
}

BOOST_AUTO_TEST_CASE(small_differences_of_large_numbers_survive) {
  Panel panel;
  panel.x.interval = {0, 1};
  panel.y.interval = {1e6, 1e6 + 1e-3};
  panel.series = {{"a", {0, 1}, {1e6 + 1e-3, 1e6}, 0}};
  const Tree drawing = parsed(draw(panel, 10).str());
  std::istringstream origin(attribute(find(drawing, "g", "panel").at(0), "data-origin"));
  double x = -1, y = -1;
  origin >> x >> y;
  BOOST_TEST(x == 0);
  BOOST_TEST(std::abs(y - 1e6) < 1e-4);
  const std::vector<std::size_t> rows = {0, 1};
  BOOST_TEST(attribute(find(drawing, "g", "series").at(0), "data-y") ==
             float_text(panel.series[0].y, rows, y));
  // Not on a logarithmic axis, whose small numbers count.
  panel.y.scale = std::make_shared<LogScale>();
  BOOST_TEST(attribute(find(parsed(draw(panel, 10).str()), "g", "panel").at(0), "data-origin") ==
             "0 0");
}

BOOST_AUTO_TEST_CASE(a_rough_path_has_some_thousand_vertices) {
  Panel panel;
  panel.series = {{"a", {}, {}, 0}};
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> anywhere(0, 1);
  for (int i = 0; i < 50'000; ++i) {
    panel.series[0].x.push_back(anywhere(generator));
    panel.series[0].y.push_back(anywhere(generator));
  }
  const auto path = find(find(parsed(draw(panel).str()), "g", "series").at(0), "path").at(0);
  const auto vertices = std::ranges::count(attribute(path, "d"), 'L');
  BOOST_TEST(vertices > 3900);
  BOOST_TEST(vertices < 4000);
}

BOOST_AUTO_TEST_SUITE_END()
