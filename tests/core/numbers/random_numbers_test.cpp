#include "courant/core/numbers/random_numbers.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <vector>

// Mistakes that these cases have to notice: the exponential variable is kept with exp(-(E - 1)²) instead of half of that;
// signs are all positive; von Neumann's runs are counted from one; the number of the stream is not in its seed.
BOOST_AUTO_TEST_SUITE(random_numbers_test)

using courant::RandomNumbers;

namespace {

double normal_distribution(double x) { return std::erfc(-x / std::numbers::sqrt2) / 2.0; }

// The greatest distance of the share of numbers below x from F(x), times √n (Kolmogorov, Smirnov).
template <class Distribution>
double kolmogorov(std::vector<double> numbers, const Distribution& F) {
  std::ranges::sort(numbers);
  const double n = static_cast<double>(numbers.size());
  double greatest = 0.0;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const double below = static_cast<double>(k) / n, value = F(numbers[k]);
    greatest = std::max({greatest, value - below, below + 1.0 / n - value});
  }
  return greatest * std::sqrt(n);
}

constexpr int kCount = 20'000;
// 0.001 of samples are farther.
constexpr double kFar = 1.95;

}  // namespace

BOOST_AUTO_TEST_CASE(numbers_of_one_stream_and_first_numbers_of_many_have_their_distributions) {
  std::vector<double> normal, uniform, first_normal, first_uniform;
  RandomNumbers one(7, "g", 0);
  for (int i = 0; i < kCount; ++i) {
    normal.push_back(one.normal());
    uniform.push_back(one.uniform());
    first_normal.push_back(RandomNumbers(1, "g", static_cast<std::uint64_t>(i)).normal());
    first_uniform.push_back(RandomNumbers(1, "u", static_cast<std::uint64_t>(i)).uniform());
  }
  const auto line = [](double x) { return x; };
  BOOST_TEST(kolmogorov(normal, normal_distribution) < kFar);
  BOOST_TEST(kolmogorov(first_normal, normal_distribution) < kFar);
  BOOST_TEST(kolmogorov(uniform, line) < kFar);
  BOOST_TEST(kolmogorov(first_uniform, line) < kFar);
  // The test sees a deviation of 1.05 for 1.
  BOOST_TEST(kolmogorov(normal, [](double x) { return normal_distribution(x / 1.05); }) > kFar);
}

// By another implementation of seed_seq and mt19937_64, tests/core/numbers/random_numbers.py.
BOOST_AUTO_TEST_CASE(the_numbers_are_these_on_every_machine) {
  BOOST_TEST(RandomNumbers(1, "u", 0).uniform() == 0.8421135896612401);
  BOOST_TEST(RandomNumbers(1, "u", 1).uniform() == 0.20172298979151249);
  BOOST_TEST(RandomNumbers(1, "g", 0).normal() == -0.6910688682576749);
  BOOST_TEST(RandomNumbers(1, "g", 1).normal() == 0.24287588109934188);
  BOOST_TEST(RandomNumbers((std::uint64_t{1} << 40) + 5, "noise", 999).normal() ==
             -0.3733207179441882);
}

BOOST_AUTO_TEST_SUITE_END()
