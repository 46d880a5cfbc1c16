#include "courant/integrators/maps/chordal.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/integrators/maps/theta.hpp"

BOOST_AUTO_TEST_SUITE(chordal)

using namespace courant;
using Eigen::Vector3d;

// The point between is the middle of the geodesic, and v leads along the chord, with
// ‖v‖ = 2 tan(angle/2).
BOOST_AUTO_TEST_CASE(bisects_the_angle) {
  const Chordal map(std::make_shared<Sphere>(2));
  const double angle = 1.1;
  const Vector3d x0(1.0, 0.0, 0.0), x1(std::cos(angle), std::sin(angle), 0.0);
  const auto [x, v] = map.inverse(x0, x1);
  const Vector3d middle(std::cos(angle / 2), std::sin(angle / 2), 0.0);
  BOOST_TEST((x - middle).norm() < 1e-15);
  BOOST_TEST(v.norm() == 2.0 * std::tan(angle / 2), boost::test_tools::tolerance(1e-14));
  BOOST_TEST(v.dot(x1 - x0) == v.norm() * (x1 - x0).norm(), boost::test_tools::tolerance(1e-14));
}

// It is the midpoint rule of the projective retraction, in closed form.
BOOST_AUTO_TEST_CASE(is_the_midpoint_rule_of_the_projective_retraction) {
  const auto sphere = std::make_shared<Sphere>(3, Sphere::projective());
  const Chordal map(sphere);
  const Theta other(sphere, 0.5);
  std::mt19937 generator(2);
  const VectorXd x = sphere->random_point(generator);
  const VectorXd v = sphere->random_tangent(x, 1.7, generator);
  const auto [a0, a1] = map.forward(x, v);
  const auto [b0, b1] = other.forward(x, v);
  BOOST_TEST((a0 - b0).norm() + (a1 - b1).norm() < 1e-15);
  const auto [c, w] = other.inverse(a0, a1);  // by Newton's method
  BOOST_TEST((c - x).norm() + (w - v).norm() < 1e-13);
}

BOOST_AUTO_TEST_CASE(opposite_points_are_outside) {
  const Chordal map(std::make_shared<Sphere>(2));
  BOOST_TEST(!map.inverse(Vector3d::UnitX(), -Vector3d::UnitX()).x.allFinite());
  BOOST_CHECK_THROW(Chordal(nullptr), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
