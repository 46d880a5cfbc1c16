#define BOOST_TEST_MODULE courant_core
#include <boost/test/unit_test.hpp>
