#define BOOST_TEST_MODULE courant_systems
#include <boost/test/unit_test.hpp>
