#include "courant/manifolds/rotation.hpp"

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "courant/core/expressions/derivative.hpp"

// Mistakes that these cases have to notice:
//  * rotations by more than a half turn come out negative
//  * a reflection is taken for near a rotation
BOOST_AUTO_TEST_SUITE(rotation)

using namespace courant;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

Vector3d random_unit(std::mt19937& generator) {
  std::normal_distribution<double> normal;
  return Vector3d::NullaryExpr([&] { return normal(generator); }).normalized();
}

Matrix3d rotation_about(const Vector3d& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

}  // namespace

BOOST_AUTO_TEST_CASE(hat_is_the_cross_product) {
  const Vector3d v(1.0, 2.0, 3.0);
  const Vector3d w(-0.5, 4.0, 2.5);
  BOOST_TEST((values(hat(constants(v))) * w - v.cross(w)).norm() == 0.0);
  BOOST_TEST((values(vee(hat(constants(v)))) - v).norm() == 0.0);
}

BOOST_AUTO_TEST_CASE(exponential_and_logarithm_agree_with_the_axis_and_angle) {
  std::mt19937 generator(3);
  for (const double angle : {0.0, 1e-9, 1e-4, 0.5, 2.0, 3.0, std::numbers::pi - 1e-3,
                             std::numbers::pi - 1e-6, std::numbers::pi - 1e-9}) {
    const Vector3d axis = random_unit(generator);
    const Matrix3d R = rotation_about(axis, angle);
    BOOST_TEST((values(rotation_exponential(constants(Vector3d(angle * axis)))) - R).norm() <
               2e-15);
    BOOST_TEST((values(rotation_logarithm(constants(R))) - angle * axis).norm() < 4e-15);
  }
}

BOOST_AUTO_TEST_CASE(cayley_is_the_fraction_and_the_half_angle_tangent) {
  std::mt19937 generator(5);
  for (const double length : {1e-8, 0.7, 2.0, 30.0}) {
    const Vector3d v = length * random_unit(generator);
    const Matrix3d a = values(hat(constants(v)));
    const Matrix3d one = Matrix3d::Identity();
    const Matrix3d expected = (one - a / 2).inverse() * (one + a / 2);
    const MatrixXd R = values(rotation_cayley(constants(v)));
    BOOST_TEST((R - expected).norm() < 1e-14);
    BOOST_TEST((R - rotation_about(v / length, 2.0 * std::atan(length / 2))).norm() < 1e-14);
    BOOST_TEST((values(rotation_inverse_cayley(constants(R))) - v).norm() <
               1e-15 * (4.0 + length * length));
  }
}

// With each of the four entries of the quaternion largest, and half turns included.
BOOST_AUTO_TEST_CASE(quaternion_in_every_branch) {
  for (const Eigen::Vector4d& raw :
       {Eigen::Vector4d(1.0, 0.2, -0.3, 0.1), Eigen::Vector4d(0.1, -1.0, 0.3, 0.2),
        Eigen::Vector4d(0.2, 0.3, 1.0, -0.1), Eigen::Vector4d(0.3, -0.2, 0.1, -1.0),
        Eigen::Vector4d(0.5, 0.5, 0.5, 0.5), Eigen::Vector4d(1e-12, 0.6, -0.8, 0.0)}) {
    const Eigen::Vector4d q = raw.normalized();
    const Matrix3d R = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
    BOOST_TEST((values(quaternion(constants(R))) - q).norm() < 5e-16 * 4);
    BOOST_TEST((values(rotation_of(constants(q))) - R).norm() < 2e-15);
  }
}

// The derivative of R ↦ log(R) along R exp(t ŵ) at an angle 1e-6 below π, in every branch of the
// quaternion, against the closed form 1 + v̂/2 + (1 - θ/2 cot θ/2)/θ² v̂² applied to w.
BOOST_AUTO_TEST_CASE(derivative_of_the_logarithm_near_a_half_turn) {
  const Vector3d w(0.3, -0.4, 0.5);
  for (const Vector3d& axis : {Vector3d(1.0, 0.1, 0.2), Vector3d(0.1, 1.0, -0.2),
                               Vector3d(-0.1, 0.2, 1.0), Vector3d(1.0, 1.0, 1.0)}) {
    for (const double angle : {1e-8, 1e-4, 1.0, 3.0, std::numbers::pi - 1e-6}) {
      const Vector3d v = angle * axis.normalized();
      Graph graph;
      const ExprVector t = graph.variables("t", 1);
      const ExprMatrix R = rotation_exponential(constants(v)) *
                           rotation_exponential(ExprVector(t[0] * constants(w)));
      const ExprVector rate = tangent(rotation_logarithm(R), t, ExprVector::Ones(1));
      const VectorXd measured = values(substitute(rate, t, ExprVector::Zero(1)));
      const double factor =
          angle < 1e-3 ? 1.0 / 12 : (1.0 - angle / 2 / std::tan(angle / 2)) / (angle * angle);
      const Vector3d expected = w + v.cross(w) / 2 + factor * v.cross(v.cross(w));
      BOOST_TEST((measured - expected).norm() < 1e-9 * (angle > 3.1 ? 1.0 : 1e-5));
    }
  }
}

BOOST_AUTO_TEST_CASE(nearest_rotation_keeps_rotations_and_rejects_reflections) {
  std::mt19937 generator(11);
  const Matrix3d R = rotation_about(random_unit(generator), 1.2);
  Matrix3d symmetric;
  symmetric << 1.1, 0.2, 0.0, 0.2, 0.9, -0.1, 0.0, -0.1, 1.3;
  BOOST_TEST((nearest_rotation(R) - R).norm() < 2e-15);
  BOOST_TEST((nearest_rotation(R * symmetric) - R).norm() < 4e-15);  // the polar factor
  BOOST_CHECK_THROW(nearest_rotation(-R), std::domain_error);
}

BOOST_AUTO_TEST_SUITE_END()
