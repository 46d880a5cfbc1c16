#include "courant/core/expressions/c_prelude.hpp"

#include <boost/test/unit_test.hpp>
#include <string>

namespace courant {
namespace {

BOOST_AUTO_TEST_SUITE(c_prelude_test)

BOOST_AUTO_TEST_CASE(a_source_gets_the_functions_that_it_calls_and_no_others) {
  const auto defines = [](const std::string& source, const std::string& name) {
    return c_prelude(source).find("static double " + name + "(") != std::string::npos;
  };
  const std::string names[] = {"courant_power", "courant_stumpff", "courant_arccos_factor"};
  for (const std::string& called : names)
    for (const std::string& name : names)
      BOOST_TEST(defines("a = " + called + "(2, b);", name) == (name == called));
  BOOST_TEST(c_prelude("a = sin(b);") == "#include <math.h>\n\n");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace
}  // namespace courant
