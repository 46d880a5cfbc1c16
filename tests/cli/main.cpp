#define BOOST_TEST_MODULE courant_cli
#include <boost/test/unit_test.hpp>
