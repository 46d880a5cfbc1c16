#define BOOST_TEST_MODULE courant_reporting
#include <boost/test/unit_test.hpp>
