#include "courant/core/algebra/polynomial_relations.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

namespace courant {
namespace {

// Factors 0, 1, 2 are the coordinates of x, 3, 4, 5 those of p.
Polynomial factor(int number) { return {{{{number, 1}}, 1.0}}; }

Polynomial sum(const Polynomial& a, const Polynomial& b, double scale = 1.0) {
  Polynomial result = a;
  for (const auto& [monomial, c] : b)
    if ((result[monomial] += scale * c) == 0.0) result.erase(monomial);
  return result;
}

Polynomial multiple(const Polynomial& a, const Polynomial& b) {
  Polynomial result;
  for (const auto& [of_a, c] : a)
    for (const auto& [of_b, d] : b) result = sum(result, {{product(of_a, of_b), c * d}});
  return result;
}

Polynomial dot(int a, int b) {
  Polynomial result;
  for (int i = 0; i < 3; ++i) result = sum(result, multiple(factor(a + i), factor(b + i)));
  return result;
}

const Polynomial one = {{Monomial{}, 1.0}};
const Polynomial on_sphere = sum(dot(0, 0), one, -1.0);

// T*S² as its bundle says it: x (x·p) = 0.
std::vector<Polynomial> cotangent_bundle() {
  std::vector<Polynomial> relations = {on_sphere};
  for (int i = 0; i < 3; ++i) relations.push_back(multiple(factor(i), dot(0, 3)));
  return relations;
}

}  // namespace

// Mistakes that these cases have to notice:
//  * consequences of several relations are not found, and x·p stays on T*S²
//  * what an element makes reducible is dropped from the basis
//  * factors that are to be eliminated stay in all relations
//  * low powers lead high ones
BOOST_AUTO_TEST_SUITE(polynomial_relations_test)

BOOST_AUTO_TEST_CASE(products_and_quotients_of_monomials) {
  const Monomial a = {{0, 2}, {3, 1}}, b = {{0, 1}, {1, 1}};
  BOOST_TEST((product(a, b) == Monomial{{0, 3}, {1, 1}, {3, 1}}));
  BOOST_TEST((product(a, b, -1) == Monomial{{0, 1}, {1, -1}, {3, 1}}));
  BOOST_TEST((product(a, a, -1) == Monomial{}));
}

BOOST_AUTO_TEST_CASE(multiples_of_relations_vanish_and_nothing_else) {
  for (const bool backwards : {false, true}) {
    const PolynomialRelations relations({on_sphere}, {.backwards = backwards});
    BOOST_TEST(relations.remainder(multiple(on_sphere, sum(factor(3), factor(0)))).empty());
    BOOST_TEST((relations.remainder(dot(0, 0)) == one));
    BOOST_TEST((relations.remainder(dot(3, 3)) == dot(3, 3)));
    BOOST_TEST(!relations.remainder(sum(on_sphere, one, 0.5)).empty());
  }
}

// x·p itself is no given relation: Σ xᵢ xᵢ (x·p) = x·p.
BOOST_AUTO_TEST_CASE(consequences_of_several_relations_are_found) {
  for (const bool backwards : {false, true}) {
    const PolynomialRelations relations(cotangent_bundle(), {.backwards = backwards});
    BOOST_TEST(relations.remainder(dot(0, 3)).empty());
    BOOST_TEST(relations.remainder(multiple(dot(0, 3), dot(3, 3))).empty());
    BOOST_TEST(!relations.remainder(dot(3, 3)).empty());
    // |x × p|² = |p|².
    const Polynomial cross =
        sum(multiple(dot(0, 0), dot(3, 3)), multiple(dot(0, 3), dot(0, 3)), -1.0);
    BOOST_TEST(relations.remainder(sum(cross, dot(3, 3), -1.0)).empty());
  }
}

// x² = y and x = 1, in this order: y = 1.
BOOST_AUTO_TEST_CASE(relations_that_others_reduce_are_not_lost) {
  const PolynomialRelations relations(
      {sum(multiple(factor(0), factor(0)), factor(1), -1.0), sum(factor(0), one, -1.0)});
  BOOST_TEST((relations.remainder(factor(1)) == one));
}

BOOST_AUTO_TEST_CASE(equal_polynomials_have_one_remainder) {
  const PolynomialRelations relations(cotangent_bundle());
  const Polynomial a = multiple(multiple(factor(0), factor(0)), factor(4));
  const Polynomial b = sum(a, multiple(multiple(factor(2), factor(5)), dot(0, 3)), 3.0);
  BOOST_TEST((relations.remainder(a) == relations.remainder(b)));
}

// x u + y = 0, y u + x = 0 with u to be eliminated: x² = y², and u is no longer there.
BOOST_AUTO_TEST_CASE(a_factor_is_eliminated) {
  const Polynomial x = factor(0), y = factor(1), u = factor(2);
  const std::vector<Polynomial> relations = {sum(multiple(x, u), y), sum(multiple(y, u), x)};
  const PolynomialRelations basis(relations, {.eliminated_from = 2, .eliminated_to = 3});
  const Polynomial expected = sum(multiple(x, x), multiple(y, y), -1.0);
  bool found = false;
  for (const Polynomial& element : basis.basis()) found = found || element == expected;
  BOOST_TEST(found);
  for (const Polynomial& relation : relations) BOOST_TEST(basis.remainder(relation).empty());
  // u is greater than x and y to any power.
  const PolynomialRelations solved({sum(u, multiple(x, multiple(x, y)))},
                                   {.eliminated_from = 2, .eliminated_to = 3});
  BOOST_TEST((solved.remainder(u) == sum({}, multiple(x, multiple(x, y)), -1.0)));
}

// A denominator is a factor with a negative power, which no relation touches.
BOOST_AUTO_TEST_CASE(denominators_stay) {
  const PolynomialRelations relations({on_sphere});
  const Polynomial below = {{{{7, -1}}, 1.0}};
  BOOST_TEST((relations.remainder(multiple(dot(0, 0), below)) == below));
  const PolynomialRelations none({sum(below, one, -1.0)});
  BOOST_TEST((none.remainder(below) == below));
}

BOOST_AUTO_TEST_CASE(what_grows_without_end_is_refused) {
  // x² = x y z w …: every step makes longer sums.
  Polynomial longer;
  for (int i = 0; i < 40; ++i) longer = sum(longer, {{{{i, 1}, {i + 41, 1}}, 1.0}});
  const PolynomialRelations relations({sum(longer, one)});
  Polynomial power = longer;
  BOOST_CHECK_NO_THROW(relations.remainder(power));
  Polynomial many;
  for (int i = 1; i < 80; ++i)
    many = sum(many, multiple({{{{0, 1}, {41, 1}}, 1.0}}, {{{{200 + i, 1}}, 1.0}}));
  BOOST_CHECK_THROW(relations.remainder(many), std::length_error);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
