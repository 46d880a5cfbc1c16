#include "courant/core/algebra/factor_table.hpp"

#include <boost/test/unit_test.hpp>
#include <stdexcept>

namespace courant {
// Mistakes that these cases have to notice:
//  * factors stand as they came
//  * a negative term may come first
BOOST_AUTO_TEST_SUITE(factor_table_test)

BOOST_AUTO_TEST_CASE(factors_with_one_text_are_one) {
  FactorTable table;
  const int x = table.number({.text = "x", .variable = 7});
  BOOST_TEST(table.number({.text = "x", .variable = 7}) == x);
  BOOST_TEST(table.number({.text = "sin(x)"}) != x);
  BOOST_TEST(table[x].text == "x");
}

// Whichever came first: x before y, and sums behind what is none.
BOOST_AUTO_TEST_CASE(factors_stand_in_the_order_of_the_variables) {
  FactorTable table;
  const int sum = table.number({.text = "(x + 1)", .is_sum = true});
  const int y = table.number({.text = "y", .variable = 2});
  const int x = table.number({.text = "x", .variable = 1});
  const int cosine = table.number({.text = "cos(y)"});
  BOOST_TEST(table.text({{{{y, 1}, {x, 1}}, 2.0}, {{{y, 2}}, -1.0}, {{{x, 2}}, -1.0}}) ==
             "2*x*y - x^2 - y^2");
  BOOST_TEST(table.text({{{{sum, 2}, {cosine, 1}}, 1.0}}) == "cos(y)*(x + 1)^2");
  BOOST_TEST(table.text({{{{sum, -1}, {x, 1}, {cosine, -1}}, 0.5}}) == "x/(2*cos(y)*(x + 1))");
  BOOST_TEST(table.text({{{{sum, 1}}, 1.0}}) == "x + 1");
  BOOST_TEST(table.text({{{{sum, 1}}, -1.0}}) == "-(x + 1)");
  BOOST_TEST(table.text({{{{y, 1}}, 1.0}, {{{sum, 1}}, -1.0}}) == "y - (x + 1)");
  BOOST_TEST(table.text({{{{y, 1}}, 1.0}, {{{sum, 1}}, 1.0}}) == "y + x + 1");
  BOOST_TEST(table.text({}) == "0");
}

BOOST_AUTO_TEST_CASE(the_first_term_is_that_of_the_text) {
  FactorTable table;
  const int y = table.number({.text = "y", .variable = 2});
  const int x = table.number({.text = "x", .variable = 1});
  for (const double a : {-2.0, 2.0})
    for (const double b : {-3.0, 3.0})
      for (const double c : {-1.0, 1.0}) {
        const Polynomial sum = {{{{y, 2}}, a}, {{{y, 1}, {x, 1}}, b}, {{{x, 1}}, c}, {{}, -4.0}};
        const auto first = table.first_in_order(sum);
        BOOST_TEST((first == table.in_order(sum).front()));
        BOOST_TEST((first.second > 0.0) == (a > 0.0 || b > 0.0 || c > 0.0));
      }
}

BOOST_AUTO_TEST_CASE(long_texts_are_refused) {
  FactorTable table;
  Polynomial sum;
  for (int i = 0; i < 300; ++i)
    sum.emplace(Monomial{{table.number({.text = "a" + std::to_string(i)}), 1}}, 1.0);
  BOOST_CHECK_THROW(table.text(sum), std::length_error);
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
