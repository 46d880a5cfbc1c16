#include "courant/core/numbers/double_double.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>

#include "courant/core/numbers/quadruple.hpp"

// Mistakes that these cases have to notice:
//  * the low part of a sum, of a product or of a quotient is dropped
//  * a product takes the halves of one factor twice
BOOST_AUTO_TEST_SUITE(double_double_test)

using namespace courant;

namespace {

Quadruple quadruple(const DoubleDouble& a) { return Quadruple(a.high) + Quadruple(a.low); }

// Next to `size`.
double error(const DoubleDouble& a, const Quadruple& exact, double size) {
  return std::fabs(static_cast<double>(quadruple(a) - exact)) / size;
}

}  // namespace

BOOST_AUTO_TEST_CASE(agrees_with_quadruples) {
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  std::uniform_int_distribution<int> exponent(-60, 60);
  const auto random = [&] {
    const double high = std::ldexp(normal(generator), exponent(generator));
    return DoubleDouble::ordered_sum(high, high * 0x1p-54 * normal(generator));
  };
  constexpr double rounding = 0x1p-101;
  for (int trial = 0; trial < 1000; ++trial) {
    const DoubleDouble a = random(), b = random();
    const Quadruple A = quadruple(a), B = quadruple(b);
    const double sum = std::fabs(a.high) + std::fabs(b.high);
    BOOST_TEST(error(a + b, A + B, sum) < rounding);
    BOOST_TEST(error(a - b, A - B, sum) < rounding);
    BOOST_TEST(error(a * b, A * B, std::fabs(a.high * b.high)) < rounding);
    BOOST_TEST(error(a / b, A / B, std::fabs(a.high / b.high)) < rounding);
    BOOST_TEST(error(-a, -A, std::fabs(a.high)) == 0.0);
  }
}

BOOST_AUTO_TEST_CASE(keeps_what_double_loses) {
  const DoubleDouble one = 1.0, tiny = 0x1p-100;
  BOOST_TEST((one + tiny - one).high == 0x1p-100);
  BOOST_TEST((one - one).is_zero());
  // (1 + 2⁻⁵²)² - 1 - 2⁻⁵¹ = 2⁻¹⁰⁴
  const DoubleDouble a = 1.0 + 0x1p-52;
  BOOST_TEST((a * a - one - DoubleDouble(0x1p-51)).high == 0x1p-104);
  // 3 · (1/3) - 1 of round-off alone.
  BOOST_TEST(std::fabs((one / 3.0 * 3.0 - one).high) < 0x1p-104);
}

BOOST_AUTO_TEST_SUITE_END()
