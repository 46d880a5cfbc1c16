#include "courant/plotting/curve_data.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>

#include "courant/plotting/decimation.hpp"
#include "courant/plotting/drawing.hpp"

namespace courant::plot {
// Mistakes that these cases have to notice:
//  * times with a gap are taken for even
//  * the last time, which may be between two rows, spoils the distance of all
//  * steps of 256 rows are written in one byte
//  * a curve in space has more rows than can be turned at once
//  * steps are not counted among the letters
BOOST_AUTO_TEST_SUITE(curve_data_test)

namespace {

// A curve over the times first + k·distance, with a last one of its own.
Series over_time(std::size_t rows, double first, double distance, double last) {
  Series series{"a", {}, {}, 0};
  for (std::size_t k = 0; k < rows; ++k) {
    series.x.push_back(k + 1 == rows ? last : first + distance * static_cast<double>(k));
    series.y.push_back(std::sin(0.37 * static_cast<double>(k)));
  }
  return series;
}

std::string bytes_of(const std::string& base64_text) {
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char letter : base64_text) {
    if (letter == '=') break;
    bits = bits << 6 | static_cast<std::uint32_t>(letters.find(letter));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 255u);
  }
  return bytes;
}

}  // namespace

BOOST_AUTO_TEST_CASE(even_times_are_three_numbers) {
  // Of 0.1 k no distance is the same as the next one, in double.
  const auto even = even_times(over_time(1000, 2, 0.1, 101.85).x);
  BOOST_TEST_REQUIRE(even.has_value());
  BOOST_TEST(even->first == 2);
  BOOST_TEST(std::abs(even->distance - 0.1) < 1e-14);
  BOOST_TEST(even->last == 101.85);
}

BOOST_AUTO_TEST_CASE(other_times_are_not_even) {
  BOOST_TEST(!even_times(std::vector<double>{0, 1}).has_value());
  BOOST_TEST(!even_times(std::vector<double>{0, 1, 2.1, 3}).has_value());
  BOOST_TEST(!even_times(std::vector<double>{0, 0, 0, 0}).has_value());
  BOOST_TEST(!even_times(std::vector<double>{3, 2, 1, 0}).has_value());
  BOOST_TEST(!even_times(std::vector<double>{0, std::nan(""), 2, 3}).has_value());
  BOOST_TEST(!even_times(std::vector<double>{0, 1, 2, std::nan("")}).has_value());
}

BOOST_AUTO_TEST_CASE(few_rows_go_along_as_they_are) {
  const Series series = over_time(40, 0, 0.5, 19.5);
  const CurveData data = curve_data(series, 100);
  BOOST_TEST(data.rows == 40);
  BOOST_TEST(data.stretches == 0);
  BOOST_TEST(data.steps.empty());
  BOOST_TEST(data.times == "0 0.5 19.5");
  BOOST_TEST(data.x.empty());
  BOOST_TEST(data.y == float_text(series.y, evenly_spaced_rows(40, 40)));
  // Times that are not even go along, less their origin.
  const Series uneven{"a", {10, 11, 13, 14}, {1, 2, 3, 4}, 0};
  BOOST_TEST(curve_data(uneven, 9, {10, 0}).x ==
             float_text(std::vector<double>{0, 1, 3, 4}, evenly_spaced_rows(4, 4)));
}

BOOST_AUTO_TEST_CASE(the_rows_of_a_thinned_curve_are_known) {
  for (const auto& [rows, width] : {std::pair{1000, 1}, {30'000, 2}, {3'000'000, 4}}) {
    const Series series = over_time(static_cast<std::size_t>(rows), 0, 1, rows + 0.5);
    const std::size_t most = 42;
    const CurveData data = curve_data(series, most);
    const auto kept = rows_of_extrema(series.y, most);
    BOOST_TEST(data.stretches == 20);
    const std::string bytes = bytes_of(data.steps);
    BOOST_TEST_REQUIRE(bytes.size() == (kept.size() - 1) * static_cast<std::size_t>(width));
    std::size_t row = 0;
    for (std::size_t i = 1; i < kept.size(); ++i) {
      for (int byte = 0; byte < width; ++byte) {
        const std::size_t place = (i - 1) * static_cast<std::size_t>(width);
        row += static_cast<std::size_t>(
                   static_cast<unsigned char>(bytes[place + static_cast<std::size_t>(byte)]))
               << 8 * byte;
      }
      BOOST_TEST(row == kept[i]);
    }
    BOOST_TEST(data.y == float_text(series.y, kept));
  }
}

BOOST_AUTO_TEST_CASE(curves_with_a_time_have_rows_at_equal_distances) {
  Series path = over_time(1000, 0, 1, 999);
  path.t = path.x;
  const auto kept = evenly_spaced_rows(1000, 50);
  CurveData data = curve_data(path, 50);
  BOOST_TEST(data.stretches == 0);
  BOOST_TEST(data.x == float_text(path.x, kept));
  BOOST_TEST(data.times == "0 1 999");
  BOOST_TEST(data.t.empty());
  path.t[5] = 5.5;
  data = curve_data(path, 50);
  BOOST_TEST(data.times.empty());
  BOOST_TEST(data.t == float_text(path.t, kept));
}

BOOST_AUTO_TEST_CASE(a_curve_in_space_has_four_thousand_rows) {
  Series curve = over_time(10'000, 0, 1, 9999);
  curve.t = curve.z = curve.x;
  BOOST_TEST(curve_data(curve, 9000).z == float_text(curve.z, evenly_spaced_rows(10'000, 4000)));
}

BOOST_AUTO_TEST_CASE(as_many_rows_fit_as_fill_the_letters) {
  Series path = over_time(20'000, 0, 1, 19'999), curve = over_time(9000, 0, 1, 8999);
  path.t = path.x;
  Series uneven = over_time(700, 0, 1, 699);
  uneven.x[3] = 3.5;
  const std::vector<const Series*> all = {&path, &curve, &uneven};
  const auto letters = [&](std::size_t rows) {
    std::size_t sum = 0;
    for (const Series* one : all) {
      const CurveData data = curve_data(*one, rows);
      sum += data.steps.size() + data.x.size() + data.y.size() + data.z.size() + data.t.size();
    }
    return sum;
  };
  for (const std::size_t most : {20'000u, 60'000u, 150'000u}) {
    const std::size_t rows = rows_that_fit(all, most);
    BOOST_TEST(letters(rows) <= most + 24);  // three attributes end in = or ==
    BOOST_TEST(letters(rows + 100) > most);
  }
  // All of them, and never none.
  BOOST_TEST(rows_that_fit(all, 10'000'000) == 20'000);
  BOOST_TEST(rows_that_fit(all, 0) == 16);
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant::plot
