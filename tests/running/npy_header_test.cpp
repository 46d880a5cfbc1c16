#include "courant/running/npy_header.hpp"

#include <boost/test/unit_test.hpp>

// Mistakes that these cases have to notice:
//  * its length depends on the shape
//  * the length that it tells is another one
BOOST_AUTO_TEST_SUITE(npy_header_test)

using namespace courant;

BOOST_AUTO_TEST_CASE(is_what_numpy_writes) {
  const std::string small = npy_header({3, 2}), large = npy_header({1'000'000, 40, 123'456'789});
  BOOST_TEST(small.size() == kNpyHeader);
  BOOST_TEST(large.size() == kNpyHeader);
  BOOST_TEST(kNpyHeader % 64 == 0u);  // numbers are aligned
  BOOST_TEST(small.substr(0, 8) == std::string("\x93NUMPY\x01\x00", 8));
  BOOST_TEST(static_cast<unsigned char>(small[8]) + 256 * static_cast<unsigned char>(small[9]) ==
             static_cast<int>(kNpyHeader) - 10);
  const std::string dictionary = "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2), }";
  BOOST_TEST(small.substr(10, dictionary.size()) == dictionary);
  BOOST_TEST(small.back() == '\n');
  BOOST_TEST(large.find("(1000000, 40, 123456789)") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
