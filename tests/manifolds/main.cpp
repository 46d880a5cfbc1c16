#define BOOST_TEST_MODULE courant_manifolds
#include <boost/test/unit_test.hpp>
