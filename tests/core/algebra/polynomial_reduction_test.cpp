#include "courant/core/algebra/polynomial_reduction.hpp"

#include <boost/test/unit_test.hpp>
#include <stdexcept>

namespace courant {
// Mistakes that these cases have to notice:
//  * round-off of numbers that cancel is written
//  * part of a relation is taken for a multiple of it
//  * there is no end to what is written
//  * polynomials have any number of terms
BOOST_AUTO_TEST_SUITE(polynomial_reduction_test)

namespace {

// Factors: 0 and 1 are x and y, 2 and 3 the sine and the cosine of an angle.
const Monomial one = {}, x = {{0, 1}}, y = {{1, 1}}, x2 = {{0, 2}}, y2 = {{1, 2}};
const Monomial sine2 = {{2, 2}}, cosine2 = {{3, 2}};
const Polynomial unit_circle = {{x2, 1.0}, {y2, 1.0}, {one, -1.0}};

}  // namespace

BOOST_AUTO_TEST_CASE(multiples_of_all_terms_become_that_of_the_constant) {
  PolynomialReduction reduction({});
  reduction.assume(unit_circle);
  // 2 x² y + 2 y³ + x = 2 y + x
  const Polynomial sum = {{product(x2, y), 2.0}, {{{1, 3}}, 2.0}, {x, 1.0}};
  BOOST_CHECK((reduction.reduced(sum) == Polynomial{{y, 2.0}, {x, 1.0}}));
  // All terms have to be there, in the same ratio.
  const Polynomial other = {{x2, 1.0}, {y2, 2.0}};
  BOOST_CHECK((reduction.reduced(other) == other));
  BOOST_CHECK((reduction.reduced({{x2, 1.0}}) == Polynomial{{x2, 1.0}}));
}

// x² + y² = l² with a parameter l: a l² is a constant as a number is.
BOOST_AUTO_TEST_CASE(parameters_are_numbers) {
  PolynomialReduction reduction({});
  constexpr int l = 4;
  const Monomial l2 = {{l, 2}};
  reduction.add_parameter(l);
  reduction.assume({{x2, 1.0}, {y2, 1.0}, {l2, -1.0}});
  BOOST_CHECK((reduction.reduced({{product(x2, y), 2.0}, {{{1, 3}}, 2.0}}) ==
               Polynomial{{product(y, l2), 2.0}}));
  BOOST_CHECK((reduction.reduced({{product(x2, l2, -1), 1.0}, {product(y2, l2, -1), 1.0}}) ==
               Polynomial{{one, 1.0}}));
  BOOST_CHECK((reduction.reduced({{l2, 1.0}}) == Polynomial{{l2, 1.0}}));
}

// x y = 1 and x = y² have y³ = 1 as a consequence.
BOOST_AUTO_TEST_CASE(consequences_of_several_relations_hold_once_they_are_concluded) {
  PolynomialReduction reduction({});
  reduction.assume({{product(x, y), 1.0}, {one, -1.0}});
  reduction.assume({{x, 1.0}, {y2, -1.0}});
  const Polynomial cube = {{{{1, 3}}, 1.0}, {one, -1.0}};
  BOOST_CHECK((reduction.reduced(cube) == cube));
  reduction.conclude({});
  BOOST_CHECK(reduction.reduced(cube).empty());
}

BOOST_AUTO_TEST_CASE(squares_of_sine_and_cosine_add_to_one) {
  PolynomialReduction reduction({});
  reduction.add_circle(2, 3);
  BOOST_CHECK((reduction.plus({{sine2, 3.0}}, {{cosine2, 3.0}, {x, 1.0}}) ==
               Polynomial{{one, 3.0}, {x, 1.0}}));
  BOOST_CHECK((reduction.plus({{sine2, 1.0}}, {{cosine2, 1.0}}, -1.0) ==
               Polynomial{{sine2, 1.0}, {cosine2, -1.0}}));
  PolynomialReduction to_cosines({.in_cosines = true});
  to_cosines.add_circle(2, 3);
  BOOST_CHECK((to_cosines.reduced({{sine2, 1.0}}) == Polynomial{{one, 1.0}, {cosine2, -1.0}}));
}

BOOST_AUTO_TEST_CASE(round_off_of_a_sum_is_zero) {
  PolynomialReduction reduction({});
  Polynomial sum = {{x, 0.1 + 0.2}};
  reduction.add(sum, x, -0.3);
  BOOST_CHECK(sum.empty());
  reduction.add(sum, x, 1.0);
  reduction.add(sum, x, -1.0 + 1e-13);
  BOOST_TEST(sum.size() == 1u);
}

BOOST_AUTO_TEST_CASE(work_has_an_end) {
  PolynomialReduction small({.most_terms = 2});
  BOOST_CHECK_NO_THROW(small.plus({{x, 1.0}}, {{y, 1.0}}));
  BOOST_CHECK_THROW(small.plus({{x, 1.0}, {y, 1.0}}, {{one, 1.0}}), std::length_error);
  PolynomialReduction short_of_work({.most_work = 10});
  Polynomial sum;
  for (int i = 0; i < 10; ++i) short_of_work.add(sum, x, 1.0);
  BOOST_CHECK_THROW(short_of_work.add(sum, x, 1.0), std::length_error);
  PolynomialReduction looking({.most_work = 10});
  for (int i = 0; i < 5; ++i) BOOST_CHECK_NO_THROW(looking.reduced({{x, 1.0}, {y, 1.0}}));
  BOOST_CHECK_THROW(looking.reduced({{x, 1.0}}), std::length_error);
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
