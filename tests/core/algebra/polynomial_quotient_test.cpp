#include "courant/core/algebra/polynomial_quotient.hpp"

#include <boost/test/unit_test.hpp>

namespace courant {
// Mistakes that these cases have to notice:
//  * 1 + cos² becomes a sine
//  * the lowest terms need not divide each other
BOOST_AUTO_TEST_SUITE(polynomial_quotient_test)

namespace {

// Factors: 0 and 1 are x and y, 2 and 3 the sine and the cosine of an angle.
const Circles angle = {{2, 3}};
const Monomial x = {{0, 1}}, y = {{1, 1}}, one = {}, sine2 = {{2, 2}}, cosine2 = {{3, 2}};

}  // namespace

BOOST_AUTO_TEST_CASE(sines_become_cosines_and_come_back) {
  const Polynomial circle = {{sine2, 3.0}, {cosine2, 3.0}};
  BOOST_CHECK((in_cosines(circle, angle) == Polynomial{{one, 3.0}}));
  const Polynomial fourth = in_cosines({{{{2, 4}}, 1.0}}, angle);  // (1 - cos²)²
  BOOST_CHECK((fourth == Polynomial{{one, 1.0}, {cosine2, -2.0}, {{{3, 4}}, 1.0}}));
  BOOST_CHECK((with_sines({{x, 2.0}, {product(x, cosine2), -2.0}, {y, 1.0}}, angle) ==
               Polynomial{{product(x, sine2), 2.0}, {y, 1.0}}));
  // 1 + cos² is no sine.
  BOOST_CHECK(
      (with_sines({{one, 1.0}, {cosine2, 1.0}}, angle) == Polynomial{{one, 1.0}, {cosine2, 1.0}}));
}

BOOST_AUTO_TEST_CASE(exact_quotients_are_found) {
  // x² - y² = (x + y) (x - y).
  const Polynomial sum = {{x, 1.0}, {y, 1.0}}, squares = {{{{0, 2}}, 1.0}, {{{1, 2}}, -1.0}};
  BOOST_CHECK((quotient(squares, sum) == Polynomial{{x, 1.0}, {y, -1.0}}));
  BOOST_CHECK(!quotient({{{{0, 2}}, 1.0}, {{{1, 2}}, 1.0}}, sum));
  BOOST_CHECK(!quotient(sum, {}));
  BOOST_CHECK((quotient({}, sum) == Polynomial{}));
  // 1 - cos⁴ = (1 + cos²) sin².
  BOOST_CHECK((quotient({{one, 1.0}, {{{3, 4}}, -1.0}}, {{one, 1.0}, {cosine2, 1.0}}, angle) ==
               Polynomial{{one, 1.0}, {cosine2, -1.0}}));
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
