#include "courant/core/language/formula_lexer.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/core/language/formula_error.hpp"

BOOST_AUTO_TEST_SUITE(formula_lexer_test)

using namespace courant;
using formula::tokenize;
using formula::TokenKind;

namespace {

void check_refused(const std::string& text, std::size_t column, const std::string& message) {
  BOOST_CHECK_EXCEPTION(tokenize(text), FormulaError, [&](const FormulaError& error) {
    BOOST_TEST(error.what() == message);
    BOOST_TEST(error.column() == column);
    return true;
  });
}

}  // namespace

BOOST_AUTO_TEST_CASE(splits_a_formula_into_words) {
  const std::string text = "r[i+1]' >= .5e-3*θ_1 && !(x<2)";
  std::vector<std::string> words;
  for (const formula::Token& token : tokenize(text)) words.emplace_back(token.text);
  const std::vector<std::string> expected{"r",   "[",  "i", "+", "1", "]", "'", ">=", ".5e-3", "*",
                                          "θ_1", "&&", "!", "(", "x", "<", "2", ")",  ""};
  BOOST_TEST(words == expected, boost::test_tools::per_element());
  BOOST_TEST((tokenize(text).back().kind == TokenKind::end));
}

BOOST_AUTO_TEST_CASE(reads_numbers_to_the_last_bit) {
  for (const auto& [text, value] : {std::pair{"0", 0.0},
                                    {"12", 12.0},
                                    {".5", 0.5},
                                    {"5.", 5.0},
                                    {"1e-3", 1e-3},
                                    {"0.1", 0.1},
                                    {"6.02214076E+23", 6.02214076e23},
                                    {"1.7976931348623157e308", 1.7976931348623157e308},
                                    {"5e-324", 5e-324}})
    BOOST_TEST(tokenize(text).front().number == value);
  BOOST_TEST(tokenize("2e").size() == 3);   // 2 and e
  BOOST_TEST(tokenize("0x1").size() == 3);  // 0 and x1
}

BOOST_AUTO_TEST_CASE(columns_are_characters) {
  const std::string text = "θ +\tÅé*x";
  const auto tokens = tokenize(text);
  std::vector<std::size_t> columns;
  for (const formula::Token& token : tokens) columns.push_back(token.column);
  BOOST_TEST(columns == (std::vector<std::size_t>{1, 3, 5, 7, 8, 9}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(names) {
  for (const char* name : {"x", "_", "p_x2", "θ", "Ω_1", "été", "ж", "crank.x", "a.b1.θ"})
    BOOST_TEST(formula::is_name(name), name);
  for (const char* text :
       {"", "2x", "x y", "x'", "r[0]", "x+", " x", "∂x", "×", ".x", "x.", "x.1", "x..y"})
    BOOST_TEST(!formula::is_name(text), text);
}

BOOST_AUTO_TEST_CASE(refuses_what_is_no_word) {
  check_refused("a $ b", 3, "column 3: unexpected \"$\"");
  check_refused("θ·x", 2, "column 2: unexpected \"·\" (did you mean \"*\"?)");
  check_refused("x − y", 3, "column 3: unexpected \"−\" (did you mean \"-\"?)");
  check_refused("x²", 2, "column 2: unexpected \"²\" (did you mean \"^2\"?)");
  check_refused("x**2", 2, "column 2: unexpected \"**\" (did you mean \"^\"?)");
  check_refused("x = 2", 3, "column 3: unexpected \"=\" (did you mean \"==\"?)");
  check_refused("a & b", 3, "column 3: unexpected \"&\" (did you mean \"&&\"?)");
  check_refused("a | b", 3, "column 3: unexpected \"|\" (did you mean \"||\"?)");
  check_refused("∂x", 1, "column 1: unexpected \"∂\"");
  check_refused("1e999", 1, "column 1: number 1e999 is outside the range of double precision");
  check_refused("x + 1e-999", 5,
                "column 5: number 1e-999 is outside the range of double precision");
  check_refused("x.", 2, "column 2: unexpected \".\"");
  check_refused("x. y", 2, "column 2: unexpected \".\"");
  check_refused("x..y", 2, "column 2: unexpected \".\"");
  check_refused(std::string("x\0", 2), 2, "column 2: unexpected byte 0x00");
  check_refused("x\xff", 2, "column 2: unexpected byte 0xff");
  check_refused("\xce", 1, "column 1: unexpected byte 0xce");      // the first half of a letter
  check_refused("\xe2\x88", 1, "column 1: unexpected byte 0xe2");  // two thirds of a sign
  check_refused(std::string(1'000'001, ' '), 1,
                "column 1: formula has 1000001 bytes; expected at most 1000000");
}

BOOST_AUTO_TEST_SUITE_END()
