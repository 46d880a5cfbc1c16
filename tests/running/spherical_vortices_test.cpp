#include "courant/systems/spherical_vortices.hpp"

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>
#include <numbers>

#include "problems.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(spherical_vortices)

namespace {

using Eigen::Vector3d;
using test::method_1, test::method_2;

constexpr double kPi = std::numbers::pi;

}  // namespace

// Two vortices turn about Σ Γ_i x_i at the rate ‖Σ Γ_i x_i‖/(2π ‖x₀ - x₁‖²).
BOOST_AUTO_TEST_CASE(two_vortices_turn_about_their_moment) {
  const auto pair =
      test::problem({{"system", {{"type", "spherical-vortices"}, {"strengths", {1, -0.3}}}},
                     {"initial", {{"x", {{1, 0, 0}, {0.6, 0, 0.8}}}}}});
  const Vector3d first(1.0, 0.0, 0.0), second(0.6, 0.0, 0.8);
  const Vector3d moment = first - 0.3 * second;
  const double time = 5.0;
  const double angle = time * moment.norm() / (2.0 * kPi * (first - second).squaredNorm());
  const Eigen::AngleAxisd turn(angle, moment.normalized());
  VectorXd exact(6);
  exact << turn * first, turn * second;
  BOOST_TEST((pair.end("dopri5", time, 200) - exact).norm() < 1e-11);
  for (const char* map : {"chordal", "exponential", "spherical-midpoint"})
    for (const Json& method : {method_1(map), method_2(map)})
      BOOST_TEST(std::abs(pair.order(method, time, exact) - 2.0) < 0.15, method.dump());
}

// Exactly by the spherical midpoint map, and not by the others.
BOOST_AUTO_TEST_CASE(moment_map_of_five) {
  const auto five = test::problem(test::experiment_file("spherical_vortices"));
  const SphericalVortices vortices((VectorXd(5) << 1.0, 0.5, -0.7, 1.3, 0.9).finished());
  const VectorXd before = values(vortices.moment(constants(five.ladder.point.x)));
  const auto change = [&](const char* map) {
    const VectorXd x = five.end(method_1(map), 25.0, 500);
    for (Index i = 0; i < 5; ++i) BOOST_TEST(std::abs(x.segment(3 * i, 3).norm() - 1.0) < 2e-14);
    return (values(vortices.moment(constants(x))) - before).norm();
  };
  BOOST_TEST(change("spherical-midpoint") < 1e-13);
  BOOST_TEST(change("chordal") > 1e-6);
  BOOST_TEST(change("exponential") > 1e-6);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
