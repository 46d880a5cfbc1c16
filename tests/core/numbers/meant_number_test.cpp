#include "courant/core/numbers/meant_number.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

// Mistakes that these cases have to notice:
//  * a short decimal is taken for a fraction (core/numbers/meant_number.cpp)
//  * π stands above the line where it is below (core/numbers/meant_number.hpp)
BOOST_AUTO_TEST_SUITE(meant_number_test)

using namespace courant;

BOOST_AUTO_TEST_CASE(short_numbers_are_decimals) {
  const MeantNumber number = meant_number(-1.25e-3);
  BOOST_TEST(number.is_negative);
  BOOST_TEST(!number.fraction);
  BOOST_TEST(number.digits == "125");
  BOOST_TEST(number.exponent == -5);
  BOOST_TEST(!meant_number(0.5).fraction);
  BOOST_TEST(meant_number(6e23).digits == "6");
  BOOST_TEST(meant_number(6e23).exponent == 23);
}

BOOST_AUTO_TEST_CASE(long_ones_are_fractions_where_there_is_one) {
  const struct {
    double number;
    int p, q, power_of_pi;
  } cases[] = {{1.0 / 3.0, 1, 3, 0},
               {22.0 / 7.0, 22, 7, 0},
               {-std::numbers::pi, 1, 1, 1},
               {0.75 * std::numbers::pi, 3, 4, 1},
               {2.0 / std::numbers::pi, 2, 1, -1}};
  for (const auto& [number, p, q, power_of_pi] : cases) {
    const auto found = meant_number(number).fraction;
    BOOST_TEST_REQUIRE(found.has_value());
    BOOST_TEST(found->p == p);
    BOOST_TEST(found->q == q);
    BOOST_TEST(found->power_of_pi == power_of_pi);
    BOOST_TEST(std::fabs(found->value(std::numbers::pi) - std::fabs(number)) <=
               1e-15 * std::fabs(number));
  }
  BOOST_TEST(!meant_number(0.123456789012345).fraction);
}

BOOST_AUTO_TEST_SUITE_END()
