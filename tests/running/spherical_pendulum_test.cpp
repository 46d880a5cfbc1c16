// The spherical pendulum on T*S² and with a rod in R³, against elliptic integrals.
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "problems.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(spherical_pendulum)

namespace {

using Eigen::Vector3d;
using test::method_1, test::method_2;

// H = |p|²/2 + g z with the data of the experiments: at the upper height with horizontal velocity.
constexpr double kGravity = 2.0, kHeight = -0.8, kSpeed = 0.9, kAzimuth = 0.5;

// The period of the height and by how much the azimuth advances in it. The heights where ż = 0 are
// roots of ż² = 2 (E - g z)(1 - z²) - J².
struct Period {
  double time, advance;
};
Period period() {
  const double J = kSpeed * std::sqrt(1.0 - kHeight * kHeight);
  const double E = kSpeed * kSpeed / 2.0 + kGravity * kHeight;
  // The cubic z³ - E/g z² - z + … divided by z - kHeight.
  const double b = -E / kGravity + kHeight, c = -1.0 + b * kHeight;
  const double root = std::sqrt(b * b - 4.0 * c);
  const double lower = (-b - root) / 2.0, upper = kHeight, other = (-b + root) / 2.0;
  const double rate = std::sqrt(kGravity * (other - lower) / 2.0);
  const double k = std::sqrt((upper - lower) / (other - lower));
  const double advance = std::comp_ellint_3(k, (upper - lower) / (1.0 - lower)) / (1.0 - lower) +
                         std::comp_ellint_3(k, -(upper - lower) / (1.0 + lower)) / (1.0 + lower);
  return {2.0 * std::comp_ellint_1(k) / rate, J / rate * advance};
}

// Place and velocity after one period: the first ones, turned.
VectorXd after_one_period(double azimuth = kAzimuth) {
  const double angle = azimuth + period().advance;
  const double radius = std::sqrt(1.0 - kHeight * kHeight);
  VectorXd x(6);
  x << radius * std::cos(angle), radius * std::sin(angle), kHeight, -kSpeed * std::sin(angle),
      kSpeed * std::cos(angle), 0.0;
  return x;
}

}  // namespace

BOOST_AUTO_TEST_CASE(on_the_sphere_against_elliptic_integrals) {
  const auto pendulum = test::problem(test::experiment_file("spherical_pendulum"));
  const double time = period().time;
  const VectorXd exact = after_one_period();
  BOOST_TEST((pendulum.end("dopri5", time, 500) - exact).norm() < 1e-10);
  for (const char* map : {"exponential", "chordal", "spherical-midpoint"})
    for (const Json& method : {method_1(map), method_2(map)})
      BOOST_TEST(std::abs(pendulum.order(method, time, exact) - 2.0) < 0.15, method.dump());
}

BOOST_AUTO_TEST_CASE(with_a_rod_against_elliptic_integrals) {
  const auto pendulum = test::problem(test::experiment_file("spherical_pendulum_constrained"));
  const double time = period().time;
  const VectorXd exact = after_one_period();
  BOOST_TEST((pendulum.end("dopri5", time, 500) - exact).norm() < 1e-9);
  BOOST_TEST(std::abs(pendulum.order(method_2("midpoint"), time, exact) - 2.0) < 0.15);
}

// In the plane y = 0 the rod has no part in the equation for y, but it has as soon as the pendulum
// leaves the plane: what the integrators need is more than what the first point shows.
BOOST_AUTO_TEST_CASE(with_a_rod_from_a_special_point) {
  Json experiment = test::experiment_file("spherical_pendulum_constrained");
  experiment["initial"] = {{"x", {0.6, 0, -0.8}}, {"v", {0, 0.9, 0}}};
  experiment.erase("expect");
  const auto pendulum = test::problem(experiment);
  const double time = period().time;
  const VectorXd exact = after_one_period(0.0);
  BOOST_TEST((pendulum.end("dopri5", time, 500) - exact).norm() < 1e-9);
  BOOST_TEST(std::abs(pendulum.order(method_2("midpoint"), time, exact) - 2.0) < 0.15);
}

// The moment map of turns about the vertical, the sphere and its cotangent planes.
BOOST_AUTO_TEST_CASE(what_is_kept_on_the_sphere) {
  const auto pendulum = test::problem(test::experiment_file("spherical_pendulum"));
  for (const char* map : {"exponential", "chordal", "spherical-midpoint"}) {
    const VectorXd x = pendulum.end(method_1(map), 40.0, 2000);
    BOOST_TEST(std::abs(x.head(3).norm() - 1.0) < 2e-14);
    BOOST_TEST(std::abs(x.head(3).dot(x.tail(3))) < 1e-14);
    BOOST_TEST(std::abs(x[0] * x[4] - x[1] * x[3] - 0.6 * kSpeed) < 1e-12);
  }
  const VectorXd x = pendulum.end("rk2", 40.0, 2000);
  BOOST_TEST(std::abs(x.head(3).norm() - 1.0) > 1e-5);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
