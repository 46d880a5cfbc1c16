#include "courant/extensions/importing/different_names.hpp"

#include <boost/test/unit_test.hpp>

// Mistakes that these cases have to notice:
//  * a new name is that of a later word
BOOST_AUTO_TEST_SUITE(different_names_test)

using courant::DifferentNames;
using courant::identifier;

BOOST_AUTO_TEST_CASE(what_is_no_letter_becomes_an_underscore) {
  BOOST_TEST(identifier("R-1") == "R_1");
  BOOST_TEST(identifier("x1.m") == "x1_m");
  BOOST_TEST(identifier("o+") == "o_plus");
  BOOST_TEST(identifier("o-") == "o_minus");
  BOOST_TEST(identifier("+") == "_");
  BOOST_TEST(identifier("a+b") == "a_b");
}

BOOST_AUTO_TEST_CASE(different_words_get_different_names) {
  DifferentNames names({"r-1", "r_1", "r.1"});
  BOOST_TEST(names.of("r_1") == "r_1");
  BOOST_TEST(names.of("r-1") == "r_1_2");
  BOOST_TEST(names.of("r.1") == "r_1_3");
  BOOST_TEST(names.of("r-1") == "r_1_2");
}

// Also one that comes later in the netlist.
BOOST_AUTO_TEST_CASE(a_word_that_is_an_identifier_is_kept) {
  DifferentNames names({"a-b", "a_b", "a_b_2"});
  BOOST_TEST(names.of("a-b") == "a_b_3");
  BOOST_TEST(names.of("a_b_2") == "a_b_2");
  BOOST_TEST(names.of("a_b") == "a_b");
}

BOOST_AUTO_TEST_SUITE_END()
