#include "courant/plotting/terminal_plot.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <sstream>

BOOST_AUTO_TEST_SUITE(terminal_plot)

using namespace courant::plot;

namespace {

std::vector<std::string> lines(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> all;
  for (std::string line; std::getline(stream, line);) all.push_back(line);
  return all;
}

std::size_t characters(const std::string& line) {
  return static_cast<std::size_t>(std::ranges::count_if(
      line, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

// 10^from to 10^to over t in [0, 100], with alternating sign.
Series exponential(const std::string& label, double from, double to, std::size_t colour) {
  Series series{label, {}, {}, colour};
  for (int i = 0; i <= 1000; ++i) {
    series.x.push_back(0.1 * i);
    series.y.push_back((i % 2 == 0 ? 1 : -1) * std::pow(10, from + (to - from) * i / 1000));
  }
  return series;
}

// Where a letter stands, as (column, line), among the lines of the plotted area of an ASCII plot.
std::vector<std::pair<std::size_t, std::size_t>> places(const std::string& text, char letter) {
  std::vector<std::pair<std::size_t, std::size_t>> found;
  const auto all = lines(text);
  for (std::size_t y = 1; y < all.size() && all[y].find("+---") == std::string::npos; ++y) {
    for (std::size_t x = 9; x < all[y].size(); ++x) {
      if (all[y][x] == letter) found.emplace_back(x, y);
    }
  }
  return found;
}

}  // namespace

BOOST_AUTO_TEST_CASE(plots_fit_their_width) {
  const std::vector<Series> series = {exponential("drifts", -8, -1, 0),
                                      exponential("stays", -4, -4, 1)};
  for (const int width : {40, 72, 80, 100}) {
    for (const bool unicode : {true, false}) {
      const TerminalOptions options{.width = width, .height = 12, .unicode = unicode};
      const std::string log_plot = terminal_log_plot("|H - H(0)|", series, options);
      const std::string paths = terminal_paths("Trajectories", series, options);
      for (const std::string& text : {log_plot, paths}) {
        for (const std::string& line : lines(text)) {
          BOOST_TEST(characters(line) <= static_cast<std::size_t>(width));
          if (!unicode) BOOST_TEST(characters(line) == line.size());
        }
      }
      BOOST_TEST(lines(log_plot).size() == 1 + 12 + 2 + 2);
      BOOST_TEST(log_plot.find("drifts   at most 0.1") != std::string::npos);
    }
  }
}

BOOST_AUTO_TEST_CASE(exponential_growth_is_a_straight_line) {
  const TerminalOptions options{.width = 80, .height = 20, .unicode = false};
  const std::vector<Series> two = {exponential("e", -8, 0, 0), exponential("flat", -8, -8, 1)};
  const std::string wide = terminal_log_plot("", two, options);
  const auto rising = places(wide, 'a'), flat = places(wide, 'b');
  BOOST_TEST_REQUIRE(rising.size() > 60);
  const auto [left, low] = rising.back();
  const auto [right, high] = rising.front();
  const double slope = (static_cast<double>(low) - static_cast<double>(high)) /
                       (static_cast<double>(right) - static_cast<double>(left));
  for (const auto& [x, y] : rising) {
    const double straight =
        static_cast<double>(low) - slope * (static_cast<double>(x) - static_cast<double>(left));
    if (x < 77) BOOST_TEST(std::abs(static_cast<double>(y) - straight) <= 1.01);
  }
  for (const auto& [x, y] : flat) BOOST_TEST(y == flat.front().second);
  BOOST_TEST(flat.front().second >= low);
}

BOOST_AUTO_TEST_CASE(circle_is_round) {
  Series circle{"circle", {}, {}, 0};
  for (int i = 0; i <= 200; ++i) {
    circle.x.push_back(7 + 2 * std::cos(i * std::numbers::pi / 100));
    circle.y.push_back(2 * std::sin(i * std::numbers::pi / 100));
  }
  const std::vector<Series> series = {circle};
  const auto dots =
      places(terminal_paths("", series, {.width = 80, .height = 20, .unicode = false}), 'a');
  const auto [left, right] = std::ranges::minmax(dots, {}, [](const auto& p) { return p.first; });
  const auto [top, bottom] = std::ranges::minmax(dots, {}, [](const auto& p) { return p.second; });
  const auto across = right.first - left.first, down = bottom.second - top.second;
  BOOST_TEST(down >= 17);
  BOOST_TEST(std::abs(static_cast<double>(across) - 2.0 * static_cast<double>(down)) <=
             2);  // characters are 1 × 2
}

BOOST_AUTO_TEST_CASE(colours_are_only_written_when_asked_for) {
  const std::vector<Series> series = {exponential("e", -3, -1, 0)};
  BOOST_TEST(terminal_log_plot("", series, {.colour = false}).find('\x1b') == std::string::npos);
  BOOST_TEST(terminal_log_plot("", series, {.colour = true}).find("\x1b[38;5;") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(degenerate_series_are_plotted) {
  const std::vector<Series> series = {{"none", {}, {}, 0},
                                      {"zero", {0, 1}, {0, 0}, 1},
                                      {"nan", {0, 1}, {std::nan(""), INFINITY}, 2},
                                      {"point", {3}, {1e-5}, 3}};
  BOOST_TEST(lines(terminal_log_plot("", series)).size() == 1 + 14 + 2 + 4);
  BOOST_TEST(!terminal_paths("", series).empty());
  BOOST_TEST(!terminal_paths("", {}).empty());
  BOOST_TEST(!terminal_log_plot("", {}).empty());
  BOOST_CHECK_THROW(terminal_log_plot("", series, {.width = 30}), std::invalid_argument);
  BOOST_CHECK_THROW(terminal_paths("", series, {.height = 2}), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
