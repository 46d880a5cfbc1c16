#include "courant/core/numbers/central_difference.hpp"

#include <Eigen/Core>
#include <boost/test/unit_test.hpp>
#include <cmath>

// Mistakes that these cases have to notice:
//  * a weight of another order
//  * the step is left out
BOOST_AUTO_TEST_SUITE(central_difference_test)

using namespace courant;

// The derivative of e^{as} at 0 is a; half the step leaves a 256th of the error.
BOOST_AUTO_TEST_CASE(of_order_eight) {
  const auto error = [](double step) {
    double slope = 0.0;
    add_central_difference([](double s) { return std::exp(3.0 * s); }, step, slope);
    return std::fabs(slope - 3.0);
  };
  BOOST_TEST(std::log2(error(0.2) / error(0.1)) == 8.0, boost::test_tools::tolerance(0.02));
}

// Polynomials up to degree 8 are differentiated but for rounding, and what is there already stays.
BOOST_AUTO_TEST_CASE(of_vectors) {
  const auto curve = [](double s) {
    return Eigen::VectorXd(Eigen::Vector2d(std::pow(s, 8) + 2.0 * s, std::pow(s, 7) - s));
  };
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Ones(2, 2);
  add_central_difference(curve, 0.25, slopes.col(1));
  BOOST_TEST(slopes(0, 0) == 1.0);
  BOOST_TEST(std::fabs(slopes(0, 1) - 3.0) < 1e-14);
  BOOST_TEST(std::fabs(slopes(1, 1)) < 1e-14);
}

BOOST_AUTO_TEST_SUITE_END()
