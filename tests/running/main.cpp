#define BOOST_TEST_MODULE courant_running
#include <boost/test/unit_test.hpp>
