#include "courant/core/algebra/sum_of_terms.hpp"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(sum_of_terms_test)

using namespace courant;

namespace {

struct Variables {
  Graph graph = {};
  Expr x = graph.variable("x"), y = graph.variable("y"), h = graph.variable("h"),
       p = graph.variable("p");
};

}  // namespace

BOOST_FIXTURE_TEST_CASE(equal_terms_meet, Variables) {
  SumOfTerms sum;
  sum.add(2.0, 1.0, x, true);
  sum.add(-2.0, 1.0, y, true);
  sum.add(3.0, 1.0, 1.0, false);
  BOOST_TEST(!sum.has_met());
  BOOST_TEST(to_string(sum.expression()) == "2*(x - y) + 3");
  BOOST_TEST(sum.operations() == 3U);
  sum.add(-2.0, 1.0, x, true);
  BOOST_TEST(sum.has_met());
  sum.drop_zeros();
  BOOST_TEST(to_string(sum.expression()) == "-2*y + 3");
}

BOOST_FIXTURE_TEST_CASE(terms_with_one_factor_are_one_product, Variables) {
  SumOfTerms sum;
  sum.add(4.0, h, x, true);
  sum.add(2.0, h, p, false);
  sum.add(1.0, 1.0, y, true);
  BOOST_TEST(sum.has_factors());
  BOOST_TEST(sum.is_exact());
  BOOST_TEST(to_string(sum.expression()) == "4*h*(2*p/4 + x) + y");
  BOOST_TEST(sum.operations() == 3U);
  sum.add(1.0, h, x, true);
  BOOST_TEST(!sum.is_exact());
}

BOOST_FIXTURE_TEST_CASE(a_term_is_taken_apart, Variables) {
  SumOfTerms inner, sum;
  inner.add(1.0, 1.0, x, true);
  inner.add(0.5, 1.0, y, true);
  const Expr q = inner.expression();
  sum.add(1.0, 1.0, q, true);
  sum.add(-1.0, 1.0, x, true);
  SumOfTerms apart = sum.with_apart(q, inner);
  BOOST_TEST(apart.has_met());
  apart.drop_zeros();
  BOOST_TEST(to_string(apart.expression()) == "0.5*y");
}

BOOST_AUTO_TEST_SUITE_END()
