#include "courant/systems/spherical_vortices.hpp"

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>
#include <numbers>
#include <random>

namespace courant {
BOOST_AUTO_TEST_SUITE(spherical_vortices)

namespace {

using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;

}  // namespace

// The velocities of the class comment, by hand.
BOOST_AUTO_TEST_CASE(equations) {
  const VectorXd strengths = (VectorXd(3) << 1.0, -0.5, 2.0).finished();
  const auto system = SphericalVortices(strengths).system();
  std::mt19937 generator(3);
  const VectorXd x = system->manifold()->random_point(generator);
  VectorXd v = VectorXd::Zero(9);
  for (Index i = 0; i < 3; ++i)
    for (Index j = 0; j < 3; ++j) {
      if (i == j) continue;
      const Vector3d a = x.segment(3 * i, 3), b = x.segment(3 * j, 3);
      v.segment(3 * i, 3) += strengths[j] / (2.0 * kPi * (a - b).squaredNorm()) * b.cross(a);
    }
  BOOST_TEST(system->residual(x, v, VectorXd(0), 0.0).norm() < 1e-14);
  BOOST_TEST(system->residual(x, 1.01 * v, VectorXd(0), 0.0).norm() > 1e-4);  // the control
}

BOOST_AUTO_TEST_CASE(errors) {
  BOOST_CHECK_THROW(SphericalVortices(Eigen::Vector2d(1.0, 0.0)), std::invalid_argument);
  const SphericalVortices vortices(Eigen::Vector2d(1.0, 2.0));
  const VectorXd apart = (VectorXd(6) << 1, 0, 0, 0, 1, 0).finished();
  const VectorXd together = (VectorXd(6) << 1, 0, 0, 1, 0, 0).finished();
  BOOST_TEST(!vortices.coinciding(apart).has_value());
  BOOST_TEST((vortices.coinciding(together) == std::pair<Index, Index>(0, 1)));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
