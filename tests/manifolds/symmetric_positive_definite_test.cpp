#include "courant/manifolds/symmetric_positive_definite.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

// Mistakes that these cases have to notice:
//  * indefinite matrices pass
BOOST_AUTO_TEST_SUITE(symmetric_positive_definite)

using namespace courant;
using Eigen::Vector3d;

// On 1 × 1 matrices R_x(v) = x exp(v/x).
BOOST_AUTO_TEST_CASE(numbers_are_scaled_exponentially) {
  const SymmetricPositiveDefinite M(1);
  const VectorXd x = VectorXd::Constant(1, 2.5);
  for (const double v : {-30.0, -1.0, 0.0, 1e-8, 4.0})
    BOOST_TEST(M.retract(x, VectorXd::Constant(1, v))[0] == 2.5 * std::exp(v / 2.5),
               boost::test_tools::tolerance(1e-14));
}

// From the unit matrix along the direction [[a, b], [b, c]]: the factor is
// [[exp a/2, 0], [b, exp c/2]].
BOOST_AUTO_TEST_CASE(two_by_two_from_the_unit_matrix) {
  const SymmetricPositiveDefinite M(2);
  const double a = 0.6, b = -1.3, c = 0.4;
  const VectorXd y = M.retract(Vector3d(1.0, 0.0, 1.0), Vector3d(a, b, c));
  const Vector3d expected(std::exp(a), std::exp(a / 2) * b, b * b + std::exp(c));
  BOOST_TEST((y - expected).norm() < 1e-14);
  BOOST_TEST((M.inverse_retract(Vector3d(1.0, 0.0, 1.0), y) - Vector3d(a, b, c)).norm() < 1e-14);
}

BOOST_AUTO_TEST_CASE(what_is_not_positive_is_not_in_it) {
  const SymmetricPositiveDefinite M(2);
  BOOST_TEST(M.point_defect(Vector3d(1.0, 0.9, 1.0)) == 0.0);
  BOOST_TEST(M.point_defect(Vector3d(1.0, 1.1, 1.0)) == std::numeric_limits<double>::infinity());
  BOOST_CHECK_THROW(M.project(Vector3d(1.0, 1.1, 1.0)), std::domain_error);
  BOOST_CHECK_THROW(SymmetricPositiveDefinite(-1), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
