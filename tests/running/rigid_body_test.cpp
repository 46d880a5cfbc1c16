// The free rigid body, reduced to S² and on T*SO(3), against closed forms.
#include <Eigen/Geometry>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <boost/test/unit_test.hpp>

#include "problems.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(rigid_body)

namespace {

using Eigen::Vector3d;
using test::method_1, test::method_2;

const Vector3d kInertia(1.0, 2.0, 3.0);
const Vector3d kStart(std::cos(1.1), 0.0, std::sin(1.1));

// The body momentum at time t by Jacobi's elliptic functions, from kStart, for ‖ξ‖² = 1 > 2 E I₂
// (Landau, Lifshitz, Mechanics, section 37).
Vector3d body_momentum(double t) {
  const double I1 = kInertia[0], I2 = kInertia[1], I3 = kInertia[2];
  const double energy = kStart.cwiseAbs2().cwiseQuotient(kInertia).sum();  // 2 E
  const double rate = std::sqrt((I3 - I2) * (1.0 - energy * I1) / (I1 * I2 * I3));
  const double k = std::sqrt((I2 - I1) * (energy * I3 - 1.0) / ((I3 - I2) * (1.0 - energy * I1)));
  double cn = 0.0, dn = 0.0;
  const double sn = boost::math::jacobi_elliptic(k, rate * t, &cn, &dn);
  return {I1 * std::sqrt((energy * I3 - 1.0) / (I1 * (I3 - I1))) * cn,
          I2 * std::sqrt((energy * I3 - 1.0) / (I2 * (I3 - I2))) * sn,
          I3 * std::sqrt((1.0 - energy * I1) / (I3 * (I3 - I1))) * dn};
}

Vector3d turned(const Vector3d& xi) { return xi.cross(xi.cwiseQuotient(kInertia)); }

}  // namespace

// Both forms of the discrete equation, as printed; and the control, that another map does not
// satisfy them.
BOOST_AUTO_TEST_CASE(example_5_6) {
  const auto body = test::problem(test::experiment_file("rigid_body"));
  const double h = 0.3;
  const auto defects = [&](const char* map) {
    const Vector3d x0 = kStart, x1 = body.end(method_1(map), h, 1);
    const double length = (x0 + x1).norm();
    const Vector3d middle = (x0 + x1) / length;
    const Vector3d first = 2.0 * (x1 - x0) / (h * length) - turned(middle);
    const Vector3d simplified =
        (x1 - x0) / h - (0.5 * (x0 + x1)).cross(middle.cwiseQuotient(kInertia));
    return std::pair(first.norm(), simplified.norm());
  };
  const auto [first, simplified] = defects("chordal");
  BOOST_TEST(first < 4e-15);  // a rounding of x₁ or two, divided by h
  BOOST_TEST(simplified < 4e-15);
  BOOST_TEST(defects("exponential").first > 1e-5);
  BOOST_TEST(defects("spherical-midpoint").first > 1e-5);
}

BOOST_AUTO_TEST_CASE(reduced_against_elliptic_functions) {
  const auto body = test::problem(test::experiment_file("rigid_body"));
  const double time = 4.0;
  const Vector3d exact = body_momentum(time);
  BOOST_TEST((body.end("dopri5", time, 200) - exact).norm() < 1e-10);
  for (const char* map : {"chordal", "exponential", "spherical-midpoint"})
    for (const Json& method : {method_1(map), method_2(map)})
      BOOST_TEST(std::abs(body.order(method, time, exact) - 2.0) < 0.15, method.dump());
}

// The Casimir and, on this system, the energy are kept; rk2 keeps neither.
BOOST_AUTO_TEST_CASE(length_and_energy_of_the_reduced_body) {
  const auto body = test::problem(test::experiment_file("rigid_body"));
  const auto energy = [](const Vector3d& xi) {
    return xi.cwiseAbs2().cwiseQuotient(kInertia).sum();
  };
  for (const char* map : {"chordal", "exponential", "spherical-midpoint"}) {
    const Vector3d xi = body.end(method_1(map), 500.0, 5000);
    BOOST_TEST(std::abs(xi.norm() - 1.0) < 1e-14);
    BOOST_TEST(std::abs(energy(xi) - energy(kStart)) < 1e-13);
  }
  const Vector3d xi = body.end("rk2", 500.0, 5000);
  BOOST_TEST(std::abs(xi.norm() - 1.0) > 1e-5);
}

BOOST_AUTO_TEST_CASE(body_momentum_on_the_group_against_elliptic_functions) {
  const auto body = test::problem(test::experiment_file("rigid_body_so3"));
  const double time = 4.0;
  const Vector3d exact = body_momentum(time);
  BOOST_TEST((body.end("dopri5", time, 200).tail(3) - exact).norm() < 1e-10);
  for (const char* map : {"exponential", "cayley"})
    for (const Json& method : {method_1(map), method_2(map)})
      BOOST_TEST(std::abs(body.order(method, time, exact, 9) - 2.0) < 0.15, method.dump());
}

// A symmetric body, I₁ = I₂: R(t) = exp(t L/I₁) exp(t (1/I₃ - 1/I₁) p₃ e₃), L the momentum in
// space.
BOOST_AUTO_TEST_CASE(attitude_of_a_symmetric_body) {
  Json experiment = test::experiment_file("rigid_body_so3");
  experiment["system"]["parameters"]["I"] = {2, 2, 0.7};
  const auto body = test::problem(experiment);
  const double time = 3.0, nutation = time * (1.0 / 0.7 - 0.5) * kStart[2];
  const Eigen::Matrix3d exact =
      (Eigen::AngleAxisd(0.5 * time, kStart) * Eigen::AngleAxisd(nutation, Vector3d::UnitZ()))
          .toRotationMatrix();
  const VectorXd attitude = exact.reshaped<Eigen::RowMajor>();
  for (const char* map : {"exponential", "cayley"})
    for (const Json& method : {method_1(map), method_2(map)})
      BOOST_TEST(std::abs(body.order(method, time, attitude) - 2.0) < 0.15, method.dump());
}

// The symmetry of the body under rotations of space: the lifts keep its moment map and stay on the
// group.
BOOST_AUTO_TEST_CASE(momentum_in_space_is_kept) {
  const auto body = test::problem(test::experiment_file("rigid_body_so3"));
  for (const char* map : {"exponential", "cayley"}) {
    const VectorXd x = body.end(method_1(map), 200.0, 2000);
    const Eigen::Matrix3d R = x.head(9).reshaped<Eigen::RowMajor>(3, 3);
    BOOST_TEST((R * x.tail(3) - kStart).norm() < 1e-12);
    BOOST_TEST((R.transpose() * R - Eigen::Matrix3d::Identity()).norm() < 5e-14);
  }
  const VectorXd x = body.end("rk2", 200.0, 2000);
  const Eigen::Matrix3d R = x.head(9).reshaped<Eigen::RowMajor>(3, 3);
  BOOST_TEST((R.transpose() * R - Eigen::Matrix3d::Identity()).norm() > 1e-4);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
