#include "courant/core/expressions/host.hpp"

#include <boost/test/unit_test.hpp>
#include <cstdlib>
#include <fstream>

BOOST_AUTO_TEST_SUITE(host_test)

using namespace courant;

BOOST_AUTO_TEST_CASE(a_variable_that_is_not_set_is_empty) {
  setenv("COURANT_HOST_TEST", "a value", 1);
  BOOST_TEST(environment_variable("COURANT_HOST_TEST") == "a value");
  unsetenv("COURANT_HOST_TEST");
  BOOST_TEST(environment_variable("COURANT_HOST_TEST") == "");
}

BOOST_AUTO_TEST_CASE(content_is_read_whole_and_missing_files_are_empty) {
  const auto file = std::filesystem::temp_directory_path() / "courant-host-test";
  std::string bytes = "two\r\nlines";
  bytes += '\0';
  std::ofstream(file, std::ios::binary) << bytes;
  BOOST_TEST((content_of(file) == bytes));
  std::filesystem::remove(file);
  BOOST_TEST(content_of(file) == "");
}

BOOST_AUTO_TEST_SUITE_END()
