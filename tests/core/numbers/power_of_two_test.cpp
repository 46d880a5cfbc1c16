#include "courant/core/numbers/power_of_two.hpp"

#include <boost/test/unit_test.hpp>
#include <limits>

// Mistakes that these cases have to notice:
//  * numbers near a power of two count as one
//  * a size is rounded down
BOOST_AUTO_TEST_SUITE(power_of_two)

using namespace courant;

BOOST_AUTO_TEST_CASE(sizes_are_rounded_by_their_logarithms) {
  BOOST_TEST(nearest_power_of_two(1.0) == 1.0);
  BOOST_TEST(nearest_power_of_two(1.41) == 1.0);
  BOOST_TEST(nearest_power_of_two(1.42) == 2.0);
  BOOST_TEST(nearest_power_of_two(5.65) == 4.0);
  BOOST_TEST(nearest_power_of_two(5.66) == 8.0);
  BOOST_TEST(nearest_power_of_two(0.36) == 0.5);
  BOOST_TEST(nearest_power_of_two(0.35) == 0.25);
}

// Over the range of numbers the result is one of 2^k, within a factor of √2.
BOOST_AUTO_TEST_CASE(all_sizes_are_near_a_power) {
  for (double size = 1e-300; size < 1e300; size *= 7.3) {
    const double power = nearest_power_of_two(size);
    int exponent = 0;
    BOOST_TEST(std::frexp(power, &exponent) == 0.5);
    BOOST_TEST(std::fabs(std::log2(size / power)) <= 0.5 + 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(are_told_from_other_numbers) {
  for (const double power : {1.0, -0.5, 1024.0, 0x1p-1070, -0x1p900})
    BOOST_TEST(is_power_of_two(power));
  for (const double other : {0.0, 3.0, -0.75, 1.0 + 0x1p-52, HUGE_VAL, std::nan("")})
    BOOST_TEST(!is_power_of_two(other));
}

BOOST_AUTO_TEST_SUITE_END()
