#include "courant/reporting/energy_trend.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

BOOST_AUTO_TEST_SUITE(energy_trend_test)

using namespace courant;
using Growth = EnergyTrend::Growth;

namespace {

EnergyTrend trend_of(const std::function<double(double)>& error, double end = 100,
                     std::size_t rows = 1001, double size = 1) {
  std::vector<double> t, e;
  for (std::size_t i = 0; i < rows; ++i) {
    t.push_back(end * static_cast<double>(i) / static_cast<double>(rows - 1));
    e.push_back(error(t.back()));
  }
  return energy_trend(t, e, size);
}

std::string found(const std::function<double(double)>& error, double end = 100,
                  std::size_t rows = 1001) {
  return word(trend_of(error, end, rows).growth);
}

}  // namespace

BOOST_AUTO_TEST_CASE(oscillations_are_bounded) {
  BOOST_TEST(found([](double t) { return 1e-3 * std::sin(t); }) == "bounded");
  BOOST_TEST(found([](double t) { return 1e-3 * (1 - std::cos(t)); }) == "bounded");
  BOOST_TEST(found([](double t) { return std::sin(t) * std::sin(0.05 * t); }, 1000) == "bounded");
  // A drift that is small next to the oscillation is no growth, and its slope is said.
  const EnergyTrend slow = trend_of([](double t) { return std::sin(t) + 1e-4 * t; }, 1000, 100'001);
  BOOST_TEST(word(slow.growth) == "bounded");
  BOOST_TEST(std::abs(slow.slope - 1e-4) < 2e-5);
}

BOOST_AUTO_TEST_CASE(drifts_and_swelling_oscillations_grow) {
  const std::function<double(double)> growing[] = {
      [](double t) { return 1e-6 * t; },
      [](double t) { return -1e-6 * t; },
      [](double t) { return 1e-6 * t * t; },
      [](double t) { return 1e-3 * std::sin(t) + 1e-4 * t; },
      [](double t) { return 1e-3 * t * std::sin(t); },
      [](double t) { return 1e-9 * std::exp(0.15 * t); },
      [](double t) { return 1e-3 * std::sqrt(t); }};
  for (const auto& error : growing) BOOST_TEST(found(error) == "growing");
  const EnergyTrend line = trend_of([](double t) { return -2e-6 * t; });
  BOOST_TEST(line.slope == -2e-6, boost::test_tools::tolerance(1e-3));
  BOOST_TEST(line.uncertainty < 1e-8);
  BOOST_TEST(line.greatest == 2e-4, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(noise_has_no_trend) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  int growing = 0;
  for (int trial = 0; trial < 200; ++trial)
    growing += found([&](double) { return normal(random); }) == "bounded" ? 0 : 1;
  BOOST_TEST(growing <= 1);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_told_is_not) {
  BOOST_TEST(found([](double t) { return std::sin(t); }, 3.0) == "too short to tell");
  BOOST_TEST(found([](double t) { return std::sin(t); }, 100, 10) == "too short to tell");
  BOOST_TEST(word(energy_trend({}, {}, 0).growth) == "too short to tell");
  BOOST_TEST(word(trend_of([](double t) { return 1e-15 * t; }).growth) == "kept to round-off");
  BOOST_TEST(found([](double) { return 0.0; }) == "kept to round-off");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  BOOST_TEST(found([&](double t) { return t < 50 ? std::sin(t) : nan; }) == "bounded");
}

BOOST_AUTO_TEST_CASE(words_have_the_numbers) {
  BOOST_TEST(in_words({Growth::growing, 4.117e-4, 1e-6, 2e-8}) ==
             "growing, at most 4.12 × 10⁻⁴, with a slope of 1 × 10⁻⁶ ± 2 × 10⁻⁸");
  BOOST_TEST(in_words({Growth::bounded, 1.6e-4, 1e-9, 2e-8})
                 .find("which is none that can be told from zero") != std::string::npos);
  BOOST_TEST(in_words({Growth::round_off, 3e-16, 0, 0}) == "kept to round-off, at most 3 × 10⁻¹⁶");
  BOOST_TEST(in_words({Growth::unclear, 0.5, 0, 0}).find("too short") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
