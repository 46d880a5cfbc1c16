#include "courant/integrators/maps/staggered.hpp"

#include <boost/test/unit_test.hpp>
#include <stdexcept>

#include "courant/integrators/maps/cotangent_lift.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/sphere.hpp"

BOOST_AUTO_TEST_SUITE(staggered)

using namespace courant;

// On T*R² with 0 for positions and 1 for momenta.
BOOST_AUTO_TEST_CASE(is_the_lift_of_explicit_euler) {
  const auto plane = std::make_shared<Euclidean>(2);
  const auto M = std::make_shared<CotangentBundle>(plane);
  const CotangentLift lift(M, std::make_shared<Theta>(plane, 0.0));
  const Staggered map(M, Eigen::Vector4d(0.0, 0.0, 1.0, 1.0));
  const VectorXd x0 = Eigen::Vector4d(0.3, -0.7, 1.1, 0.4),
                 x1 = Eigen::Vector4d(0.5, 0.2, -0.3, 0.9);
  const auto [x, v] = map.inverse(x0, x1);
  const auto [y, w] = lift.inverse(x0, x1);
  BOOST_TEST((x - y).norm() + (v - w).norm() < 1e-15);
  BOOST_TEST((x - Eigen::Vector4d(0.3, -0.7, -0.3, 0.9)).norm() == 0.0);
}

BOOST_AUTO_TEST_CASE(refuses_what_is_no_theta) {
  const auto plane = std::make_shared<Euclidean>(2);
  BOOST_CHECK_THROW(Staggered(plane, Eigen::Vector3d(0, 1, 0)), std::invalid_argument);
  BOOST_CHECK_THROW(Staggered(plane, Eigen::Vector2d(0, 1.5)), std::invalid_argument);
  BOOST_CHECK_THROW(Staggered(std::make_shared<Sphere>(2), Eigen::Vector2d(0, 1)),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
