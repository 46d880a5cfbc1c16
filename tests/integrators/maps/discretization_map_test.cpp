// What the base class does for a map that has no closed inverse, and its errors.
#include "courant/integrators/maps/discretization_map.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/integrators/maps/chordal.hpp"
#include "courant/integrators/maps/inversion.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/manifolds/stiefel.hpp"

BOOST_AUTO_TEST_SUITE(discretization_map)

using namespace courant;
using Eigen::Vector2d;
using Eigen::Vector3d;

BOOST_AUTO_TEST_CASE(inverse_by_newton) {
  const auto frames = std::make_shared<Stiefel>(4, 2);
  const Theta map(frames, 0.5);
  BOOST_TEST(!map.has_inverse());
  std::mt19937 generator(1);
  for (const double length : {0.0, 1e-8, 0.5, 1.5}) {
    const VectorXd x = frames->random_point(generator);
    const VectorXd v = frames->random_tangent(x, length, generator);
    const auto [x0, x1] = map.forward(x, v);
    const auto [y, w] = map.inverse(x0, x1);
    BOOST_TEST((y - x).norm() < 1e-12);
    BOOST_TEST((w - v).norm() < 1e-12);
  }
}

// One inversion for pairs at many points; wrong sizes are refused.
BOOST_AUTO_TEST_CASE(inversion_of_many_pairs) {
  const auto frames = std::make_shared<Stiefel>(4, 2);
  const Theta map(frames, 0.5);
  const Inversion inverse(map);
  std::mt19937 generator(2);
  for (int k = 0; k < 10; ++k) {
    const VectorXd x = frames->random_point(generator);
    const VectorXd v = frames->random_tangent(x, 1.0, generator);
    const auto [x0, x1] = map.forward(x, v);
    const auto [y, w] = inverse(x0, x1);
    BOOST_TEST((y - x).norm() + (w - v).norm() < 1e-12);
    BOOST_TEST((w - v - frames->random_tangent(x, 1e-6, generator)).norm() > 1e-7);
  }
  BOOST_CHECK_THROW(inverse(Vector2d(1.0, 0.0), VectorXd(frames->random_point(generator))),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(points_that_are_not_reached) {
  const Theta map(std::make_shared<Sphere>(2, Sphere::projective()), 0.5);
  BOOST_CHECK_THROW(map.inverse(Vector3d(Vector3d::UnitX()), Vector3d(-Vector3d::UnitX())),
                    std::domain_error);
  BOOST_CHECK_THROW(
      map.inverse(constants(Vector3d(Vector3d::UnitX())), constants(Vector3d(Vector3d::UnitY()))),
      std::logic_error);
}

BOOST_AUTO_TEST_CASE(sizes_are_checked) {
  const Chordal map(std::make_shared<Sphere>(2));
  BOOST_CHECK_THROW(map.forward(Vector2d(1.0, 0.0), Vector3d(0.0, 0.0, 1.0)),
                    std::invalid_argument);
  BOOST_CHECK_THROW(map.inverse(Vector3d(1.0, 0.0, 0.0), Vector2d(1.0, 0.0)),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
