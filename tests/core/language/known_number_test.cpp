#include "courant/core/language/known_number.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/core/language/formula.hpp"

BOOST_AUTO_TEST_SUITE(known_number_test)

using namespace courant;

namespace {

double number(const std::string& text) { return parse_formula(text, SymbolTable()).value(); }

}  // namespace

BOOST_AUTO_TEST_CASE(constants_that_are_zero_are_zero) {
  for (const char* text : {"cos(pi/2)", "sin(pi)", "0.1+0.2-0.3", "sin(pi/6)-0.5", "2*cos(pi/3)-1",
                           "sqrt(2)^2-2", "sum(i,1,10,0.1)-1", "1/3+1/3+1/3-1", "tan(pi/4)-1"})
    BOOST_TEST_CONTEXT(text) BOOST_TEST(number(text) == 0.0);
}

BOOST_AUTO_TEST_CASE(others_are_the_double_next_to_them) {
  BOOST_TEST(number("0.1+0.2") == 0.3);
  BOOST_TEST(number("sqrt(2)") == std::sqrt(2.0));
  BOOST_TEST(number("1/3") == 1.0 / 3.0);
  BOOST_TEST(number("2^0.5*2^0.5") == 2.0);
  BOOST_TEST(number("1e-30+1e-31-1.1e-30+1e-60") == 1e-60);
}

BOOST_AUTO_TEST_CASE(what_has_no_number_stays_what_it_was) {
  BOOST_TEST(std::isnan(number("sqrt(-1)")));
  BOOST_TEST(number("1/0") == INFINITY);
  BOOST_TEST(number("0^0.5") == 0.0);
  BOOST_TEST(number("(-8)^3") == -512.0);
}

BOOST_AUTO_TEST_SUITE_END()
