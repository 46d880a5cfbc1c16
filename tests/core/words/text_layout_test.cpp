#include "courant/core/words/text_layout.hpp"

#include <boost/test/unit_test.hpp>
#include <string>
#include <vector>

#include "courant/core/words/word_list.hpp"

// Mistakes that these cases have to notice:
//  * a column counts bytes, and what follows Greek letters is out of line
//  * the first term of a sum loses its sign
BOOST_AUTO_TEST_SUITE(text_layout_test)

using namespace courant;

BOOST_AUTO_TEST_CASE(counts_know_their_plural) {
  BOOST_TEST(counted(0, "term") == "0 terms");
  BOOST_TEST(counted(1, "term") == "1 term");
  BOOST_TEST(counted(12, "term") == "12 terms");
}

BOOST_AUTO_TEST_CASE(small_digits) {
  BOOST_TEST(subscript(0) == "₀");
  BOOST_TEST(subscript(127) == "₁₂₇");
  BOOST_TEST(subscript(-3) == "₋₃");
  BOOST_TEST(superscript(127) == "¹²⁷");
  BOOST_TEST(superscript(-3) == "⁻³");
}

BOOST_AUTO_TEST_CASE(derivatives_by_time) {
  BOOST_TEST(time_derivative("x - y", 0) == "x - y");
  BOOST_TEST(time_derivative("[x - y]", 1) == "d/dt [x - y]");
  BOOST_TEST(time_derivative("f", 3) == "d^3/dt^3 f");
}

BOOST_AUTO_TEST_CASE(terms_of_a_sum) {
  std::string sum;
  add_term(sum, -2.0, "a", 4);
  add_term(sum, 1.0 / 3.0, "b", 4);
  add_term(sum, -1.0, "c", 4);
  BOOST_TEST(sum == "-2 a + 0.3333 b - c");
}

BOOST_AUTO_TEST_CASE(long_texts_keep_their_beginning_and_their_ending) {
  BOOST_TEST(beginning("α₁", 5) == "α₁");
  BOOST_TEST(beginning("α₁", 4) == "α");  // of which the second has three bytes
  BOOST_TEST(beginning("₁", 1) == "");
  BOOST_TEST(shortened_between("0123456789", 10, 3) == "0123456789");
  BOOST_TEST(shortened_between("0123456789a", 10, 3) == "0123456 … 89a");
  BOOST_TEST(shortened_between("012345₀…………₀9", 10, 3) ==
             "012345 … 9");  // in the middle of a character
}

BOOST_AUTO_TEST_CASE(columns_count_characters) {
  BOOST_TEST(text_width("") == 0U);
  BOOST_TEST(text_width("α = S₁") == 6U);
  BOOST_TEST(padded("α₁", 4) == "α₁  ");
  BOOST_TEST(padded("α₁", 1) == "α₁");
  BOOST_TEST(shortened("α₁β₂", 4) == "α₁β₂");
  BOOST_TEST(shortened("α₁β₂", 3) == "α₁…");
}

BOOST_AUTO_TEST_CASE(words_in_a_row) {
  struct Named {
    std::string name;
  };
  const std::vector<std::string> words = {"a", "b", "c"};
  BOOST_TEST(word_list(words) == "a, b, c");
  BOOST_TEST(word_list(words, " ") == "a b c");
  BOOST_TEST(word_list(std::vector<std::string>()) == "");
  BOOST_TEST(word_list(std::vector<Named>{{"p"}, {""}, {"q"}}, &Named::name) == "p, , q");
}

BOOST_AUTO_TEST_SUITE_END()
