#include "courant/core/algebra/polynomial_content.hpp"

#include <boost/test/unit_test.hpp>
#include <limits>

namespace courant {
// Mistakes that these cases have to notice:
//  * the number in front is that of the leading term
//  * denominators of some terms stay in the primitive part (core/algebra/polynomial_relations.hpp)
//  * factors of the terms before are taken out of all (core/algebra/polynomial_relations.hpp)
BOOST_AUTO_TEST_SUITE(polynomial_content_test)

namespace {

struct Letters {
  FactorTable factors;
  int x = factors.number({.text = "x", .variable = 1});
  int y = factors.number({.text = "y", .variable = 2});
};

}  // namespace

BOOST_FIXTURE_TEST_CASE(what_divides_all_terms_is_taken_out, Letters) {
  // 2 x³ y + 4 x² = 2 x² (x y + 2)
  const PolynomialContent of = content({{{{x, 3}, {y, 1}}, 2.0}, {{{x, 2}}, 4.0}}, factors);
  BOOST_CHECK((of.monomial == Monomial{{x, 2}}));
  BOOST_TEST(factors.text(of.primitive_part) == "x*y + 2");
  BOOST_TEST(of.number == 2.0);
}

// y/x + x = (y + x²)/x, and x² and 1/y have x⁰ y⁻¹ in common.
BOOST_FIXTURE_TEST_CASE(denominators_are_taken_out_of_terms_that_lack_them, Letters) {
  const PolynomialContent over_x = content({{{{x, -1}, {y, 1}}, 1.0}, {{{x, 1}}, 1.0}}, factors);
  BOOST_CHECK((over_x.monomial == Monomial{{x, -1}}));
  BOOST_TEST(factors.text(over_x.primitive_part) == "x^2 + y");
  const PolynomialContent over_y = content({{{{x, 2}}, 1.0}, {{{y, -1}}, 1.0}}, factors);
  BOOST_CHECK((over_y.monomial == Monomial{{y, -1}}));
  BOOST_TEST(factors.text(over_y.primitive_part) == "x^2*y + 1");
}

// Of 19.62 x - 2 y² the 2 is taken out, with the sign of the leading positive term: 9.81 x - y².
BOOST_FIXTURE_TEST_CASE(the_number_leaves_short_ones, Letters) {
  const PolynomialContent of = content({{{{x, 1}}, 19.62}, {{{y, 2}}, -2.0}}, factors);
  BOOST_TEST(of.number == 2.0);
  BOOST_TEST(factors.text(of.primitive_part) == "9.81*x - y^2");
}

BOOST_FIXTURE_TEST_CASE(numbers_and_zero_have_a_content, Letters) {
  const PolynomialContent of_number = content({{Monomial{}, -3.0}}, factors);
  BOOST_TEST(of_number.number == -3.0);
  BOOST_CHECK(of_number.monomial.empty());
  BOOST_CHECK((of_number.primitive_part == Polynomial{{Monomial{}, 1.0}}));
  const PolynomialContent of_zero = content({}, factors);
  BOOST_TEST(of_zero.number == 1.0);
  BOOST_CHECK(of_zero.primitive_part.empty());
}

// The quotient of two of them is NaN, which is no integer.
BOOST_FIXTURE_TEST_CASE(numbers_that_overflowed_have_no_common_fraction, Letters) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const PolynomialContent of = content({{{{x, 1}}, infinite}, {{{y, 1}}, infinite}}, factors);
  BOOST_TEST(of.number == infinite);
  BOOST_CHECK(of.monomial.empty());
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
