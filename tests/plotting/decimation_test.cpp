#include "courant/plotting/decimation.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <random>

BOOST_AUTO_TEST_SUITE(decimation)

using namespace courant::plot;

namespace {

double distance_to_segment(Vertex p, Vertex a, Vertex b) {
  const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
  const double s =
      square == 0 ? 0 : std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / square, 0.0, 1.0);
  return std::hypot(p.x - a.x - s * dx, p.y - a.y - s * dy);
}

// The greatest distance of a vertex of the path from the whole of the simplified one.
double deviation(const std::vector<Vertex>& path, const std::vector<Vertex>& kept) {
  double greatest = 0;
  for (const Vertex& p : path) {
    double nearest = std::hypot(p.x - kept[0].x, p.y - kept[0].y);
    for (std::size_t i = 1; i < kept.size(); ++i) {
      nearest = std::min(nearest, distance_to_segment(p, kept[i - 1], kept[i]));
    }
    greatest = std::max(greatest, nearest);
  }
  return greatest;
}

}  // namespace

BOOST_AUTO_TEST_CASE(stretches_end_where_a_value_is_not_finite) {
  const double nan = std::nan("");
  const std::vector<double> x = {0, 1, 2, 3, 4, 5}, y = {1, 1, nan, 1, -INFINITY, 1};
  const auto stretches = finite_stretches(x, y);
  BOOST_TEST_REQUIRE(stretches.size() == 3);
  BOOST_TEST(stretches[0].size() == 2);
  BOOST_TEST(stretches[1].begin == 3);
  BOOST_TEST(stretches[2].end == 6);
  BOOST_TEST(finite_stretches({}, {}).empty());
}

BOOST_AUTO_TEST_CASE(envelope_keeps_the_extrema_of_every_piece) {
  constexpr int rows = 100'000, columns = 640;
  std::mt19937 random(3);
  std::normal_distribution<double> noise;
  std::vector<double> x(rows), y(rows);
  for (std::size_t i = 0; i < rows; ++i) x[i] = 0.1 * static_cast<double>(i), y[i] = noise(random);
  y[12'345] = 100;
  y[77'777] = -50;
  const Interval interval{x.front(), x.back()};
  const Envelope bounds = envelope(x, y, interval, columns);
  BOOST_TEST(bounds.x.size() == columns);
  BOOST_TEST(std::ranges::max(bounds.upper) == 100);
  BOOST_TEST(std::ranges::min(bounds.lower) == -50);
  // Each piece against the rows around its middle, found by their x.
  const double half = interval.length() / columns / 2;
  bool equal = true;
  for (std::size_t c = 0; c < bounds.x.size(); ++c) {
    Interval inside, around;
    for (std::size_t i = 0; i < rows; ++i) {
      const double distance = std::abs(x[i] - bounds.x[c]);
      if (distance < half * (1 - 1e-9)) inside.include(y[i]);
      if (distance < half * (1 + 1e-9)) around.include(y[i]);
    }
    equal = equal && bounds.lower[c] <= inside.lower && inside.upper <= bounds.upper[c];
    equal = equal && around.lower <= bounds.lower[c] && bounds.upper[c] <= around.upper;
  }
  BOOST_TEST(equal);
}

BOOST_AUTO_TEST_CASE(envelope_skips_pieces_without_rows) {
  const std::vector<double> x = {0, 1, 9, 10}, y = {1, 2, 3, 4};
  const Envelope bounds = envelope(x, y, {0, 10}, 10);
  BOOST_TEST(bounds.x == (std::vector<double>{0.5, 1.5, 9.5}), boost::test_tools::per_element());
  BOOST_TEST(bounds.lower == (std::vector<double>{1, 2, 3}), boost::test_tools::per_element());
  BOOST_TEST(bounds.upper == (std::vector<double>{1, 2, 4}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(simplified_path_stays_within_the_tolerance) {
  std::mt19937 random(4);
  std::normal_distribution<double> noise;
  for (const double roughness : {0.0, 0.02, 0.3, 5.0}) {
    std::vector<Vertex> path;
    for (int i = 0; i <= 2000; ++i) {
      const double s = 2 * std::numbers::pi * i / 1000.0;
      path.push_back({200 * std::cos(s) + roughness * noise(random),
                      100 * std::sin(2 * s) + roughness * noise(random)});
    }
    const std::vector<Vertex> kept = simplified(path, 0.1);
    BOOST_TEST(kept.front().x == path.front().x);
    BOOST_TEST(kept.back().y == path.back().y);
    BOOST_TEST(deviation(path, kept) <= 0.1 * (1 + 1e-9));
    if (roughness == 0) BOOST_TEST(kept.size() < path.size() / 5);
    // The negative control: leaving out every second of these vertices is seen.
    std::vector<Vertex> coarser;
    for (std::size_t i = 0; i < kept.size(); i += 2) coarser.push_back(kept[i]);
    BOOST_TEST(deviation(path, coarser) > 0.1);
  }
}

BOOST_AUTO_TEST_CASE(motion_back_and_forth_keeps_its_turning_points) {
  std::vector<Vertex> path;
  for (int i = 0; i <= 1000; ++i) path.push_back({100 * std::sin(0.05 * i), 0});
  const std::vector<Vertex> kept = simplified(path, 0.1);
  BOOST_TEST(deviation(path, kept) <= 0.1);
  BOOST_TEST(kept.size() < 80);
}

BOOST_AUTO_TEST_CASE(short_paths_are_kept) {
  BOOST_TEST(simplified({}, 0.1).empty());
  const std::vector<Vertex> one = {{1, 2}};
  BOOST_TEST(simplified(one, 0.1).size() == 1);
  const std::vector<Vertex> still = {{1, 2}, {1, 2}, {1, 2}, {1, 2}};
  BOOST_TEST(simplified(still, 0.1).size() == 2);
}

BOOST_AUTO_TEST_CASE(rows_of_extrema_keep_a_spike_the_first_and_the_last) {
  std::vector<double> y(1000, 0.5);
  y[500] = 9;
  y[700] = -9;
  const std::vector<std::size_t> rows = rows_of_extrema(y, 50);
  BOOST_TEST(rows.size() <= 50);
  BOOST_TEST(std::is_sorted(rows.begin(), rows.end()));
  for (const std::size_t row : {0, 500, 700, 999})
    BOOST_TEST((std::find(rows.begin(), rows.end(), row) != rows.end()), row);
  for (const std::size_t few : {0, 1, 2, 3, 50})
    BOOST_TEST(rows_of_extrema(std::span<const double>(y).first(few), 50).size() == few);
  BOOST_CHECK(evenly_spaced_rows(9, 3) == (std::vector<std::size_t>{0, 4, 8}));
}

BOOST_AUTO_TEST_SUITE_END()
