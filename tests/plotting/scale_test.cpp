#include "courant/plotting/scale.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

BOOST_AUTO_TEST_SUITE(scale)

using namespace courant::plot;

namespace {

std::vector<std::string> labels(const Ticks& ticks) {
  std::vector<std::string> texts;
  for (const Tick& tick : ticks.marks) {
    if (!tick.label.empty()) texts.push_back(tick.label);
  }
  return texts;
}

using Texts = std::vector<std::string>;

// What a label says, read as a person reads it.
double said(std::string text, int exponent) {
  if (const auto sign = text.find("\u2212"); sign != std::string::npos) text.replace(sign, 3, "-");
  return std::stod(text) * std::pow(10, exponent);
}

}  // namespace

BOOST_AUTO_TEST_CASE(interval_leaves_out_what_is_not_finite) {
  Interval interval;
  BOOST_TEST(interval.empty());
  const std::vector<double> values = {3, std::nan(""), -1, std::numeric_limits<double>::infinity()};
  interval.include(values);
  BOOST_TEST(interval.lower == -1);
  BOOST_TEST(interval.upper == 3);
}

BOOST_AUTO_TEST_CASE(nice_steps_are_the_least_that_suffice) {
  BOOST_TEST(nice_step(10, 10) == 1);
  BOOST_TEST(nice_step(10, 6) == 2);
  BOOST_TEST(nice_step(10, 4) == 5);
  BOOST_TEST(nice_step(10, 1) == 10);
  BOOST_TEST(nice_step(0.3, 3) == 0.1, boost::test_tools::tolerance(1e-15));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> power(-12, 12);
  for (int trial = 0; trial < 1000; ++trial) {
    const double length = std::pow(10, power(random));
    const int pieces = 1 + trial % 12;
    const double step = nice_step(length, pieces);
    BOOST_TEST(step * pieces >= length * (1 - 1e-6));
    BOOST_TEST(step * pieces <= 2.5 * length * (1 + 1e-6));
  }
}

BOOST_AUTO_TEST_CASE(linear_ticks_are_nice_numbers) {
  const LinearScale linear;
  BOOST_CHECK(labels(linear.ticks({-1.2, 26}, 6)) == (Texts{"0", "5", "10", "15", "20", "25"}));
  BOOST_CHECK(labels(linear.ticks({-0.31, 0.2}, 5)) == (Texts{"\u22120.2", "0.0", "0.2"}));
  const Ticks small = linear.ticks({0, 1.95e-4}, 4);
  BOOST_TEST(small.exponent == -4);
  BOOST_CHECK(labels(small) == (Texts{"0.0", "0.5", "1.0", "1.5"}));
  const Ticks large = linear.ticks({0, 1e6}, 5);
  BOOST_TEST(large.exponent == 6);
  BOOST_CHECK(labels(large) == (Texts{"0.0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
}

BOOST_AUTO_TEST_CASE(linear_labels_say_where_their_tick_is) {
  const LinearScale linear;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> power(-9, 9), part(-1, 1);
  for (int trial = 0; trial < 1000; ++trial) {
    const double centre = part(random) * std::pow(10, power(random));
    const double radius = std::max(std::pow(10, power(random)), 1e-9 * std::abs(centre));
    const Interval interval{centre - radius, centre + radius};
    const Ticks ticks = linear.ticks(interval, 6);
    BOOST_TEST(ticks.marks.size() >= 2);
    BOOST_TEST(ticks.marks.size() <= 7);
    for (const Tick& tick : ticks.marks) {
      BOOST_TEST(std::abs(said(tick.label, ticks.exponent) - tick.value) <=
                 1e-6 * radius + 1e-14 * std::abs(centre));
      BOOST_TEST(tick.value >= interval.lower - 1e-6 * radius);
      BOOST_TEST(tick.value <= interval.upper + 1e-6 * radius);
    }
  }
}

BOOST_AUTO_TEST_CASE(symmetric_log_is_odd_continuous_and_invertible) {
  const SymmetricLogScale scale(1e-5);
  BOOST_TEST(scale.transform(0) == 0);
  BOOST_TEST(scale.transform(1e-5) == 1);
  BOOST_TEST(scale.transform(1e-3) == 3, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(scale.transform(1e-5 * (1 + 1e-12)) == 1, boost::test_tools::tolerance(1e-11));
  double before = -std::numeric_limits<double>::infinity();
  for (double length = -6; length <= 6; length += 0.125) {
    const double value = scale.inverse(length);
    BOOST_TEST(value > before);
    BOOST_TEST(scale.transform(value) == length, boost::test_tools::tolerance(1e-13));
    BOOST_TEST(scale.transform(-value) == -length, boost::test_tools::tolerance(1e-13));
    before = value;
  }
  BOOST_CHECK_THROW(SymmetricLogScale(0), std::invalid_argument);
  BOOST_CHECK_THROW(SymmetricLogScale(-1), std::invalid_argument);
  BOOST_CHECK_THROW(SymmetricLogScale(std::nan("")), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(symmetric_log_ticks_are_powers_of_ten) {
  const SymmetricLogScale scale(1e-5);
  BOOST_CHECK(labels(scale.ticks({-2e-4, 0.12}, 8)) ==
              (Texts{"−10⁻⁴", "−10⁻⁵", "0", "10⁻⁵", "10⁻⁴", "10⁻³", "10⁻²", "10⁻¹"}));
  // The minor ticks between 10⁻⁵ and 3.5 · 10⁻⁵.
  BOOST_TEST(scale.ticks({0, 3.5e-5}, 8).marks.size() == 4);
  // Fourteen decades leave no room for each: every second, no minor ones.
  const Ticks wide = SymmetricLogScale(1e-14).ticks({0, 1}, 8);
  BOOST_CHECK(labels(wide) ==
              (Texts{"0", "10⁻¹⁴", "10⁻¹²", "10⁻¹⁰", "10⁻⁸", "10⁻⁶", "10⁻⁴", "10⁻²", "10⁰"}));
}

BOOST_AUTO_TEST_CASE(padding_makes_room_for_a_constant) {
  const LinearScale linear;
  const Interval padded = linear.padded({0, 10}, 0.05);
  BOOST_TEST(padded.lower == -0.5);
  BOOST_TEST(padded.upper == 10.5);
  for (const double value : {0.0, 1.0, -1e9, 1e-300}) {
    const Interval room = linear.padded({value, value}, 0.05);
    BOOST_TEST(room.lower < value);
    BOOST_TEST(room.upper > value);
  }
  // Rounding errors of a constant are no variation.
  BOOST_TEST(linear.padded({1, 1 + 1e-15}, 0).length() > 0.5);
  BOOST_TEST(linear.padded({1, 1 + 1e-9}, 0).length() < 1e-8);
}

BOOST_AUTO_TEST_CASE(numbers_read_well) {
  BOOST_TEST(readable(0) == "0");
  BOOST_TEST(readable(-0.697421199668691) == "−0.697421");
  BOOST_TEST(readable(4.117e-4, 4) == "4.117 × 10⁻⁴");
  BOOST_TEST(readable(-1.5e-10, 4) == "−1.5 × 10⁻¹⁰");
  BOOST_TEST(readable(300) == "300");
  BOOST_TEST(readable(999999.5, 6) == "1 × 10⁶");
  BOOST_TEST(readable(140845, 3) == "140845");
  BOOST_TEST(readable(0.001, 3) == "0.001");
  BOOST_TEST(readable(std::nan("")) == "NaN");
  BOOST_TEST(readable(-std::numeric_limits<double>::infinity()) == "−∞");
  BOOST_TEST(power_of_ten(-12, true) == "−10⁻¹²");
}

BOOST_AUTO_TEST_CASE(a_logarithmic_scale_is_one) {
  const LogScale log;
  BOOST_TEST(log.transform(1000) - log.transform(10) == 2, boost::test_tools::tolerance(1e-15));
  BOOST_TEST(log.inverse(log.transform(0.037)) == 0.037, boost::test_tools::tolerance(1e-15));
  BOOST_TEST(!std::isfinite(log.transform(0)));
  BOOST_TEST(!std::isfinite(log.transform(-1)));
  BOOST_CHECK(labels(log.ticks({3e-5, 4e-1}, 6)) == (Texts{"10⁻⁴", "10⁻³", "10⁻²", "10⁻¹"}));
  BOOST_CHECK(labels(log.ticks({1e-12, 1e0}, 4)) ==
              (Texts{"10⁻¹²", "10⁻⁹", "10⁻⁶", "10⁻³", "10⁰"}));
  // Less than two decades have more than one label.
  BOOST_CHECK(labels(log.ticks({0.015, 0.12}, 6)) == (Texts{"2·10⁻²", "5·10⁻²", "10⁻¹"}));
  for (const Tick& tick : log.ticks({0.015, 0.12}, 6).marks) {
    BOOST_TEST(tick.value >= 0.015);
    BOOST_TEST(tick.value <= 0.12);
  }
}

BOOST_AUTO_TEST_CASE(words_stand_at_whole_numbers) {
  const WordScale words({"rk2", "rk4", "dopri5"});
  BOOST_CHECK(labels(words.ticks({-0.5, 2.5}, 8)) == (Texts{"rk2", "rk4", "dopri5"}));
  BOOST_TEST(words.ticks({-0.5, 2.5}, 8).marks[2].value == 2);
  BOOST_CHECK(labels(words.ticks({0.5, 1.5}, 8)) == (Texts{"rk4"}));
  BOOST_TEST(labels(WordScale(Texts(100, "a")).ticks({0, 100}, 10)).size() == 10u);
}

BOOST_AUTO_TEST_SUITE_END()
