#define BOOST_TEST_MODULE courant_reading
#include <boost/test/unit_test.hpp>
