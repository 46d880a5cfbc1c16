#include "courant/integrators/theta.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"
#include "courant/manifolds/sphere.hpp"

using namespace courant;
using Eigen::Vector2d;
using Eigen::Vector3d;

BOOST_AUTO_TEST_SUITE(theta)

// Example 4.8.
BOOST_AUTO_TEST_CASE(on_vector_spaces) {
  const Theta map(std::make_shared<Euclidean>(2), 0.25);
  const auto [x0, x1] = map.forward(Vector2d(1.0, 2.0), Vector2d(4.0, -8.0));
  BOOST_TEST((x0 - Vector2d(0.0, 4.0)).norm() == 0.0);
  BOOST_TEST((x1 - Vector2d(4.0, -4.0)).norm() == 0.0);
  const auto [x, v] = map.inverse(x0, x1);
  BOOST_TEST((x - Vector2d(1.0, 2.0)).norm() == 0.0);
  BOOST_TEST((v - Vector2d(4.0, -8.0)).norm() == 0.0);
}

// Examples 4.9 and 4.10: both ends are retracted from x, and the whole geodesic has length ‖v‖.
BOOST_AUTO_TEST_CASE(along_geodesics) {
  const auto sphere = std::make_shared<Sphere>(2);
  const Theta map(sphere, 0.3);
  const Vector3d x(0.0, 0.0, 1.0);
  const Vector3d v(0.6, 0.8, 0.0);
  const auto [x0, x1] = map.forward(x, 2.0 * v);
  BOOST_TEST((x0 - (std::cos(0.6) * x - std::sin(0.6) * v)).norm() < 1e-15);
  BOOST_TEST((x1 - (std::cos(1.4) * x + std::sin(1.4) * v)).norm() < 1e-15);
  BOOST_TEST(sphere->inverse_retract(x0, x1).norm() == 2.0, boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(claims) {
  const auto sphere = std::make_shared<Sphere>(2);
  const auto projective = std::make_shared<Sphere>(2, Sphere::projective());
  BOOST_TEST(Theta(sphere).name() == "Theta(0.5)");
  BOOST_TEST(Theta(sphere).order() == 2);
  BOOST_TEST(Theta(sphere, 0.25).order() == 1);
  BOOST_TEST(Theta(sphere).is_symmetric());
  BOOST_TEST(!Theta(sphere, 1.0).is_symmetric());
  BOOST_TEST(Theta(sphere, 0.3).has_inverse());
  BOOST_TEST(Theta(projective, 0.0).has_inverse());
  BOOST_TEST(Theta(projective, 1.0).has_inverse());
  BOOST_TEST(!Theta(projective, 0.5).has_inverse());
}

BOOST_AUTO_TEST_CASE(errors) {
  const auto space = std::make_shared<Euclidean>(2);
  BOOST_CHECK_THROW(Theta(space, -0.1), std::invalid_argument);
  BOOST_CHECK_THROW(Theta(space, std::nan("")), std::invalid_argument);
  BOOST_CHECK_THROW(Theta(nullptr), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
