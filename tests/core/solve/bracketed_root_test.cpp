#include "courant/core/solve/bracketed_root.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <exception>

namespace courant {
// Mistakes that these cases have to notice:
//  * the search stops at an interval that is too long
BOOST_AUTO_TEST_SUITE(bracketed_root_test)

namespace {

double cubic(double x) { return x * x * x - 2.0; }

}  // namespace

BOOST_AUTO_TEST_CASE(the_interval_holds_the_zero_and_is_short) {
  const auto [low, high] = bracketed_root(cubic, {1.0, 2.0}, cubic(1.0), cubic(2.0), 1e-12, 100);
  BOOST_TEST(high - low <= 1e-12);
  BOOST_TEST(low <= std::cbrt(2.0));
  BOOST_TEST(high >= std::cbrt(2.0));
}

BOOST_AUTO_TEST_CASE(it_stops_at_the_number_of_evaluations) {
  int count = 0;
  const auto counted = [&](double x) {
    ++count;
    return cubic(x);
  };
  const auto [low, high] = bracketed_root(counted, {1.0, 2.0}, cubic(1.0), cubic(2.0), 0.0, 5);
  BOOST_TEST(count <= 5);
  BOOST_TEST(high - low > 0.0);
  BOOST_TEST(cubic(low) * cubic(high) <= 0.0);
}

BOOST_AUTO_TEST_CASE(equal_signs_are_refused) {
  BOOST_CHECK_THROW(bracketed_root(cubic, {2.0, 3.0}, cubic(2.0), cubic(3.0), 1e-12, 100),
                    std::exception);
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
