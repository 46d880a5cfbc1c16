#define BOOST_TEST_MODULE courant_integrators
#include <boost/test/unit_test.hpp>
