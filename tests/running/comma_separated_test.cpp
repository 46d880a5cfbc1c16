#include "courant/running/comma_separated.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

namespace courant {

BOOST_AUTO_TEST_SUITE(comma_separated)

BOOST_AUTO_TEST_CASE(cells) {
  BOOST_TEST(csv_cell(0.1) == "0.1");
  BOOST_TEST(csv_cell(1e-300) == "1e-300");
  BOOST_TEST(csv_cell(3) == "3");
  BOOST_TEST(csv_cell(nullptr) == "");
  BOOST_TEST(csv_cell(std::nan("")) == "");
  BOOST_TEST(csv_cell("x[0]") == "x[0]");
  BOOST_TEST(csv_cell("a, \"b\"\n") == "\"a, \"\"b\"\"\n\"");
  BOOST_TEST(csv_cell(Json({1, 2})) == "\"[1,2]\"");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
