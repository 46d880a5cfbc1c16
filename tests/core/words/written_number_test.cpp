#include "courant/core/words/written_number.hpp"

#include <boost/test/unit_test.hpp>
#include <numbers>

namespace courant {
// Mistakes that these cases have to notice:
//  * what is near a fraction is taken for it
//  * a decimal with round-off becomes a fraction
BOOST_AUTO_TEST_SUITE(written_number_test)

namespace {

void check(double value, const char* above, const char* below) {
  const WrittenNumber written = written_number(value);
  BOOST_TEST(written.above == above);
  BOOST_TEST(written.below == below);
}

BOOST_AUTO_TEST_CASE(numbers_are_written_as_people_do) {
  check(1.0, "", "");
  check(0.5, "", "2");
  check(0.125, "", "8");
  check(2.5, "2.5", "");
  check(0.2, "0.2", "");
  check(1088.0 / 1125.0, "1088", "1125");
  check(9.81, "9.81", "");
  check(1.0 / 3.0, "", "3");
  check(5.0 / 6.0, "5", "6");
  check(35.0 / 78.0, "35", "78");
  check(1000.0 / 27.0, "1000", "27");
  check(57.0 / 16.0, "57", "16");
  check(0.1375, "0.1375", "");  // as it was written, not 11/80
  check(std::numbers::pi / 4.0, "pi", "4");
  check(1.0 / (2.0 * std::numbers::pi), "", "2*pi");
  check(3.0 * std::numbers::pi, "3*pi", "");
  check(0.1234567890123, "0.123457", "");
  check(1.6e-19, "1.6e-19", "");
}

// What is near a fraction only is not written as one.
BOOST_AUTO_TEST_CASE(near_is_not_enough) {
  check(0.33333333, "0.333333", "");
  check(1.0 - 2e-16, "", "");
  check(0.1 + 0.2, "0.3", "");  // round-off does not make 3/10 of it
  BOOST_TEST(is_same_number(0.1 + 0.2, 0.3));
  BOOST_TEST(!is_same_number(0.33333333, 1.0 / 3.0));
}

}  // namespace

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
