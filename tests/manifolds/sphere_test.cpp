#include "courant/manifolds/sphere.hpp"

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

// Mistakes that these cases have to notice:
//  * the velocity along a geodesic does not turn
BOOST_AUTO_TEST_SUITE(sphere)

using namespace courant;
using Eigen::Vector3d;

// A geodesic is a rotation about x × v: Eigen's rotation is the other route.
BOOST_AUTO_TEST_CASE(exponential_rotates_along_the_great_circle) {
  const Sphere S(2);
  const Vector3d x = Vector3d(1.0, -2.0, 0.5).normalized();
  for (const double length : {1e-8, 0.3, 1.5, 3.1}) {
    const Vector3d v = length * x.cross(Vector3d(0.2, 0.1, 1.0)).normalized();
    const Vector3d axis = x.cross(v).normalized();
    const Vector3d expected = Eigen::AngleAxisd(length, axis) * x;
    BOOST_TEST((S.retract(x, v) - expected).norm() < 1e-15 * 10);
  }
}

BOOST_AUTO_TEST_CASE(logarithm_has_the_length_of_the_angle) {
  const Sphere S(3);
  std::mt19937 generator(7);
  for (int i = 0; i < 20; ++i) {
    const VectorXd x = S.random_point(generator);
    const VectorXd y = S.random_point(generator);
    // Kahan's formula for the angle, accurate everywhere.
    const double angle = 2.0 * std::atan2((x - y).norm(), (x + y).norm());
    BOOST_TEST(S.inverse_retract(x, y).norm() == angle, boost::test_tools::tolerance(1e-13));
  }
}

BOOST_AUTO_TEST_CASE(projective_retraction_follows_the_line_to_the_centre) {
  const Sphere S(2, Sphere::projective());
  const Vector3d x(0.0, 0.0, 1.0);
  const Vector3d v(3.0, -4.0, 0.0);
  const VectorXd y = S.retract(x, v);
  BOOST_TEST((y - Vector3d(3.0, -4.0, 1.0) / std::sqrt(26.0)).norm() < 1e-15);
  BOOST_TEST((S.inverse_retract(x, y) - v).norm() < 1e-14);
}

BOOST_AUTO_TEST_CASE(sizes_and_claims) {
  const Sphere S(2);
  BOOST_TEST(S.name() == "Sphere(2, exponential)");
  BOOST_TEST(S.dimension() == 2);
  BOOST_TEST(S.ambient_dimension() == 3);
  BOOST_TEST(S.tangent_dimension() == 3);
  BOOST_TEST(S.is_geodesic());
  BOOST_TEST(!Sphere(2, Sphere::projective()).is_geodesic());
  BOOST_TEST(S.injectivity_radius(Vector3d::UnitX()) == std::numbers::pi);
}

BOOST_AUTO_TEST_CASE(errors) {
  BOOST_CHECK_THROW(Sphere(-1), std::invalid_argument);
  const Sphere S(2);
  BOOST_CHECK_EXCEPTION(S.retract(VectorXd::Zero(2), VectorXd::Zero(3)), std::invalid_argument,
                        [](const auto& e) {
                          return std::string(e.what()) ==
                                 "Sphere(2, exponential)::retract: x has 2 entries, expected "
                                 "ambient_dimension() = 3.";
                        });
  BOOST_CHECK_THROW(S.project(Vector3d::Zero()), std::domain_error);
  BOOST_TEST(!S.inverse_retract(Vector3d::UnitX(), -Vector3d::UnitX()).allFinite());
}

BOOST_AUTO_TEST_SUITE_END()
