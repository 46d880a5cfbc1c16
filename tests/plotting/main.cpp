#define BOOST_TEST_MODULE courant_plotting
#include <boost/test/unit_test.hpp>
