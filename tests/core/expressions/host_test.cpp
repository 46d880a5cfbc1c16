#include "courant/core/expressions/host.hpp"

#include <boost/test/unit_test.hpp>
#include <cstdlib>

BOOST_AUTO_TEST_SUITE(host_test)

using namespace courant;

BOOST_AUTO_TEST_CASE(a_variable_that_is_not_set_is_empty) {
  setenv("COURANT_HOST_TEST", "a value", 1);
  BOOST_TEST(environment_variable("COURANT_HOST_TEST") == "a value");
  unsetenv("COURANT_HOST_TEST");
  BOOST_TEST(environment_variable("COURANT_HOST_TEST") == "");
}

BOOST_AUTO_TEST_SUITE_END()
