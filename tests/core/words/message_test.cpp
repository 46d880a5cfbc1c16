#include "courant/core/words/message.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

namespace courant {

BOOST_AUTO_TEST_SUITE(message)

BOOST_AUTO_TEST_CASE(numbers_have_the_digits_that_they_need) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  BOOST_TEST(number_text(0.1) == "0.1");
  BOOST_TEST(number_text(1.0 / 3.0, 3) == "0.333");
  BOOST_TEST(number_text(1.6e-44) == "1.6e-44");
  BOOST_TEST(number_text(5e-324) == "4.94066e-324");
  BOOST_TEST(number_text(1e300) == "1e+300");
  BOOST_TEST(number_text(0.0) == "0");
  BOOST_TEST(number_text(nan) == "nan");
  BOOST_TEST(number_text(std::copysign(nan, -1.0)) == "nan");
  BOOST_TEST(number_text(-INFINITY) == "-inf");
  BOOST_TEST(exact_text(0.1) == "0.1");
  BOOST_TEST(exact_text(1.0 / 3.0) == "0.3333333333333333");
  BOOST_TEST(exact_text(std::copysign(nan, -1.0)) == "nan");
}

BOOST_AUTO_TEST_CASE(sizes_are_rows_by_columns) { BOOST_TEST(size_text(3, 14) == "3 × 14"); }

BOOST_AUTO_TEST_CASE(quoted_text_is_between_quotation_marks) {
  BOOST_TEST(in_quotes("x y") == "\"x y\"");
}

BOOST_AUTO_TEST_CASE(messages_lose_the_place_in_the_code_and_nothing_else) {
  for (const auto& [message, text] : {
           std::pair("Sphere(2, exponential)::retract: x has 2 entries", "x has 2 entries"),
           std::pair("VectorField::VectorField: the verdict is: gauge", "the verdict is: gauge"),
           std::pair("SpecialEuclidean3::project: nearest_rotation: A is singular",
                     "A is singular"),
           std::pair("Function(a b): got 2", "got 2"),
           std::pair("solve: pivot 0 is zero", "pivot 0 is zero"),
           std::pair("discretize-first: step 3 from t = 1", "discretize-first: step 3 from t = 1"),
           std::pair("rk4: step 3", "rk4: step 3"),
           std::pair("column 9: unknown name", "column 9: unknown name"),
           std::pair("No point was found: x = 1", "No point was found: x = 1"),
           std::pair("plain words", "plain words"),
           std::pair("", ""),
       })
    BOOST_TEST(without_place(message) == text);
}

BOOST_AUTO_TEST_CASE(a_terminal_gets_no_commands) {
  BOOST_TEST(printable("\x1b[31mred\x07\n") == "\\u001b[31mred\\u0007\\u000a");
  BOOST_TEST(printable("caf\xC3\xA9 \xC2\x9B"
                       "31m \x7F") == "caf\xC3\xA9 \\u009b31m \\u007f");
  BOOST_TEST(printable("\xC2") == "\xC2");
  // Marks of direction (U+202E) and separators of lines (U+2028); other letters of two and three bytes, and what is
  // not UTF-8, stay.
  BOOST_TEST(printable("txt\xE2\x80\xAE"
                       "fdp\xE2\x80\xA8"
                       "x\xD8\x9C") == "txt\\u202efdp\\u2028x\\u061c");
  BOOST_TEST(printable("\xE2\x82\x80 \xE2\x89\xA4 \xCF\x84 \xE2\x80 \xFF") ==
             "\xE2\x82\x80 \xE2\x89\xA4 \xCF\x84 \xE2\x80 \xFF");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
