#define BOOST_TEST_MODULE courant_structures
#include <boost/test/unit_test.hpp>
