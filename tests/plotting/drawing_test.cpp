#include "courant/plotting/drawing.hpp"

#include <boost/test/unit_test.hpp>
#include <string>
#include <vector>

using namespace courant::plot;

// Mistakes that these cases have to notice:
//  * indices are units
//  * a power that is negative is not raised
BOOST_AUTO_TEST_SUITE(drawing)

// By Python: base64.b64encode(struct.pack("<4f", 1, -2.5, inf, 0)), and of the first 1, 2, 3.
BOOST_AUTO_TEST_CASE(float_text_is_base64_of_little_endian_floats) {
  const std::vector<double> values = {1, -2.5, 1e300, 0};
  const std::vector<std::size_t> rows = {0, 1, 2, 3};
  const std::vector<std::string> expected = {"", "AACAPw==", "AACAPwAAIMA=", "AACAPwAAIMAAAIB/",
                                             "AACAPwAAIMAAAIB/AAAAAA=="};
  for (std::size_t count = 0; count <= 4; ++count) {
    BOOST_TEST(float_text(values, std::span(rows).first(count)) == expected[count]);
  }
}

BOOST_AUTO_TEST_CASE(float_text_has_the_rows_that_are_asked_for) {
  const std::vector<double> values = {7, 1, 7, -2.5};
  const std::vector<std::size_t> rows = {1, 3};
  BOOST_TEST(float_text(values, rows) == "AACAPwAAIMA=");
  BOOST_TEST(float_text(values, rows, 6) == float_text(std::vector<double>{-5, -8.5}, {{0, 1}}));
}

// What stands in italics and what does not is told by tests of figures.
BOOST_AUTO_TEST_CASE(units_are_upright_with_raised_powers) {
  BOOST_TEST(mathematics("momentum [kg m^2/s]").str() == "momentum [kg m²/s]");
  BOOST_TEST(mathematics("noise [V s^-12 m^x ^]").str() == "noise [V s⁻¹² m^x ^]");
  BOOST_TEST(mathematics("area [m^2] (× 10⁻³)").str() == "area [m²] (× 10⁻³)");
  // Indices are no units.
  BOOST_TEST(mathematics("x[2]").str().find("</tspan>[2]") != std::string::npos);
  BOOST_TEST(mathematics("x [m]").str().ends_with("</tspan> [m]"));
}

BOOST_AUTO_TEST_SUITE_END()
