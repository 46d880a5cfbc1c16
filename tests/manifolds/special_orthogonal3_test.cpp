#include "courant/manifolds/special_orthogonal3.hpp"

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>
#include <numbers>

// Mistakes that these cases have to notice:
//  * reflections pass for rotations
BOOST_AUTO_TEST_SUITE(special_orthogonal3)

using namespace courant;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

VectorXd point(const Matrix3d& R) { return R.reshaped<Eigen::RowMajor>(); }

}  // namespace

BOOST_AUTO_TEST_CASE(points_are_stored_row_after_row) {
  const SpecialOrthogonal3 G;
  const Matrix3d R = Eigen::AngleAxisd(0.4, Vector3d(1.0, 2.0, -1.0).normalized()).matrix();
  const VectorXd x = point(R);
  BOOST_TEST(x[1] == R(0, 1));
  const Vector3d v(0.3, 0.1, -0.2);
  const Matrix3d expected = R * Eigen::AngleAxisd(v.norm(), v.normalized()).matrix();
  BOOST_TEST((G.retract(x, v) - point(expected)).norm() < 2e-15);
}

// Ṙ = R v̂: v is the angular velocity in the body.
BOOST_AUTO_TEST_CASE(frame_is_left_trivialised) {
  const SpecialOrthogonal3 G;
  std::mt19937 generator(2);
  const VectorXd x = G.random_point(generator);
  const Vector3d v(0.3, 0.1, -0.2);
  const Matrix3d R = x.reshaped<Eigen::RowMajor>(3, 3);
  const VectorXd velocity = G.frame(x) * v;
  const Matrix3d R_dot = velocity.reshaped<Eigen::RowMajor>(3, 3);
  const Vector3d a(1.0, -1.0, 2.0);
  BOOST_TEST((R.transpose() * R_dot * a - v.cross(a)).norm() < 2e-15);
  BOOST_TEST((G.coframe(x) * velocity - v).norm() < 1e-15);
}

BOOST_AUTO_TEST_CASE(reflections_are_not_points) {
  const SpecialOrthogonal3 G;
  BOOST_TEST(G.point_defect(point(Matrix3d::Identity())) == 0.0);
  BOOST_TEST(G.point_defect(point(-Matrix3d::Identity())) > 1.0);
  BOOST_TEST(G.point_defect(point(Matrix3d::Zero())) >= 1.0);
  BOOST_CHECK_THROW(G.project(point(-Matrix3d::Identity())), std::domain_error);
}

// x and -x in every coordinate: the point to which all of the sphere of radius π is mapped is where
// the retraction stops to be injective.
BOOST_AUTO_TEST_CASE(exponential_is_not_injective_at_the_radius) {
  const SpecialOrthogonal3 G;
  const VectorXd x = point(Matrix3d::Identity());
  const Vector3d v = std::numbers::pi * Vector3d(0.6, 0.0, 0.8);
  BOOST_TEST((G.retract(x, v) - G.retract(x, -v)).norm() < 1e-15);
  BOOST_TEST(G.injectivity_radius(x) == std::numbers::pi);
}

BOOST_AUTO_TEST_CASE(errors) {
  const SpecialOrthogonal3 G;
  BOOST_CHECK_THROW(G.retract(VectorXd::Zero(9), VectorXd::Zero(9)), std::invalid_argument);
  BOOST_CHECK_THROW(G.frame(VectorXd::Zero(3)), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
