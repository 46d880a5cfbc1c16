#include "courant/core/algebra/sum_arithmetic.hpp"

#include <boost/test/unit_test.hpp>
#include <stdexcept>

namespace courant {
namespace {

struct Sums {
  SumArithmetic sums{{}};
  Polynomial x = sums.factor({.text = "x", .variable = 1});
  Polynomial y = sums.factor({.text = "y", .variable = 2});
  Polynomial one = SumArithmetic::number(1.0);
  Polynomial x_and_1 = sums.plus(x, one);

  Polynomial root(const Polynomial& under) {
    return sums.factor({.text = "sqrt(" + sums.text(under) + ")", .sum = under, .is_root = true});
  }
};

struct Fractions : Sums {
  Fractions() {
    sums = SumArithmetic({.add_fractions = true});
    x = sums.factor({.text = "x", .variable = 1});
    y = sums.factor({.text = "y", .variable = 2});
  }
};

}  // namespace

// Mistakes that these cases have to notice:
//  * an equation is divided by what may vanish
//  * terms over the same sum stand one by one
//  * what divides both sides of a fraction stays
//  * a sum that is 0 stands in a denominator
//  * pairs of roots stay roots
BOOST_FIXTURE_TEST_SUITE(sum_arithmetic_test, Sums)

BOOST_AUTO_TEST_CASE(products_of_sums_are_multiplied_out_or_not) {
  BOOST_TEST(sums.text(sums.times(x_and_1, sums.minus(x, one))) == "x^2 - 1");
  sums.set_expanding(false);
  BOOST_TEST(sums.text(sums.times(x_and_1, sums.minus(x, one))) == "(x + 1)*(x - 1)");
  BOOST_TEST(sums.text(sums.times(x_and_1, SumArithmetic::number(2.0))) == "2*x + 2");
  BOOST_CHECK(sums.times(x_and_1, {}).empty());
}

BOOST_AUTO_TEST_CASE(powers_of_sums_cancel) {
  const Polynomial below = sums.to_power(x_and_1, -1);
  BOOST_TEST(sums.text(below) == "1/(x + 1)");
  BOOST_TEST(sums.text(sums.times(sums.to_power(x_and_1, 5), below)) == "(x + 1)^4");
  BOOST_TEST(sums.text(sums.to_power(below, -1)) == "x + 1");
  BOOST_TEST(sums.text(sums.to_power(x_and_1, 2)) == "x^2 + 2*x + 1");
  BOOST_TEST(sums.text(sums.to_power(x_and_1, 0)) == "1");
  BOOST_CHECK(sums.to_power({}, 2).empty());
  BOOST_CHECK_THROW(sums.to_power({}, -1), std::domain_error);
}

BOOST_AUTO_TEST_CASE(pairs_of_roots_become_what_is_under_them) {
  BOOST_TEST(sums.text(sums.times(root(x_and_1), root(x_and_1))) == "x + 1");
  BOOST_TEST(sums.text(sums.to_power(root(x_and_1), 3)) == "sqrt(x + 1)*(x + 1)");
  BOOST_TEST(sums.text(sums.to_power(root(x_and_1), -2)) == "1/(x + 1)");
}

BOOST_AUTO_TEST_CASE(common_factors_stand_in_front) {
  const Polynomial sum = sums.plus(sums.times(x, y), SumArithmetic::scaled(x, 2.0));
  BOOST_TEST(sums.text(sums.factored(sum)) == "x*(y + 2)");
  BOOST_TEST(sums.text(sums.factored(x)) == "x");
}

BOOST_AUTO_TEST_CASE(terms_over_one_sum_are_put_together) {
  const Polynomial below = sums.to_power(x_and_1, -1);
  const Polynomial sum = sums.plus(sums.plus(sums.times(y, below), x), below);
  BOOST_TEST(sums.text(sums.collected(sum)) == "x + (y + 1)/(x + 1)");
}

BOOST_AUTO_TEST_CASE(equations_lose_denominators_and_numbers_but_no_zeros) {
  const Polynomial over_x = sums.plus(sums.to_power(x, -1), SumArithmetic::scaled(y, -1.0));
  BOOST_TEST(sums.text(sums.equation(over_x)) == "1 - x*y");
  const Polynomial times_x = sums.plus(sums.times(x, y), x);  // holds at x = 0
  BOOST_TEST(sums.text(sums.equation(times_x)) == "x*y + x");
  BOOST_TEST(sums.leading(sums.minus(one, SumArithmetic::scaled(x, 4.0))) == -4.0);
  BOOST_TEST(sums.leading({}) == 1.0);
}

BOOST_FIXTURE_TEST_CASE(fractions_are_added_and_divided_out, Fractions) {
  // 1/(x - y) - 1/(x + y) = 2 y/((x - y) (x + y))
  const Polynomial less = sums.to_power(sums.minus(x, y), -1);
  const Polynomial more = sums.to_power(sums.plus(x, y), -1);
  BOOST_TEST(sums.text(sums.as_fraction(sums.minus(less, more))) == "2*y/((x + y)*(x - y))");
  // (x² - y²)/(x + y) = x - y
  const Polynomial squares = sums.minus(sums.times(x, x), sums.times(y, y));
  BOOST_TEST(sums.text(sums.as_fraction(sums.times(squares, more))) == "x - y");
  BOOST_TEST(sums.text(sums.as_fraction(x)) == "x");
}

BOOST_AUTO_TEST_CASE(relations_hold_in_every_result) {
  const Polynomial sine = sums.factor({.text = "sin(x)"}), cosine = sums.factor({.text = "cos(x)"});
  sums.reduction().add_circle(sine.begin()->first[0].first, cosine.begin()->first[0].first);
  BOOST_TEST(sums.text(sums.plus(sums.to_power(sine, 2), sums.to_power(cosine, 2))) == "1");
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
