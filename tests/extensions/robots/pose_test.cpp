#include "courant/extensions/robots/pose.hpp"

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

namespace courant::robots {
// Mistakes that these cases have to notice:
//  * turns of roll, pitch and yaw are in the other order
//  * capitals of an Euler sequence turn about the axes of the turned frame
//  * an inertia is not turned with its frame
//  * the parts of a body are added without what their distance adds
BOOST_AUTO_TEST_SUITE(pose_test)

namespace {

using Eigen::AngleAxisd;
using std::numbers::pi;

void require_equal(const Matrix3d& found, const Matrix3d& expected) {
  BOOST_TEST((found - expected).cwiseAbs().maxCoeff() <= 1e-15);
}

Matrix3d about(const Vector3d& axis, double angle) { return AngleAxisd(angle, axis).matrix(); }

}  // namespace

BOOST_AUTO_TEST_CASE(roll_pitch_and_yaw_are_about_fixed_axes) {
  const double r = 0.3, p = -0.4, y = 2.0;
  require_equal(of_rpy({r, p, y}), about(Vector3d::UnitZ(), y) * about(Vector3d::UnitY(), p) *
                                       about(Vector3d::UnitX(), r));
  for (const Vector3d& rpy :
       {Vector3d(0.3, -0.4, 2.0), Vector3d(-3.0, 1.2, -1.0), Vector3d(0.0, 0.0, pi)})
    BOOST_TEST((rpy_of(of_rpy(rpy)) - rpy).norm() <= 1e-14);
}

// There roll and yaw turn about one axis, and yaw is taken for 0.
BOOST_AUTO_TEST_CASE(a_pitch_of_a_quarter_turn_has_one_angle_beside_it) {
  for (const double pitch : {0.5 * pi, -0.5 * pi}) {
    const Matrix3d turned = of_rpy({0.7, pitch, 0.2});
    BOOST_TEST(rpy_of(turned)[2] == 0.0);
    BOOST_TEST((of_rpy(rpy_of(turned)) - turned).cwiseAbs().maxCoeff() <= 1e-15);
  }
}

BOOST_AUTO_TEST_CASE(quarter_turns_are_exact) {
  Matrix3d expected;
  expected << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  BOOST_TEST((of_rpy({0.0, 0.0, 0.5 * pi}) == expected));
}

BOOST_AUTO_TEST_CASE(letters_of_euler_sequences) {
  const Vector3d a(0.3, 0.5, -0.7);
  const Vector3d X = Vector3d::UnitX(), Y = Vector3d::UnitY(), Z = Vector3d::UnitZ();
  require_equal(of_euler("xyz", a), about(X, a[0]) * about(Y, a[1]) * about(Z, a[2]));
  require_equal(of_euler("zyx", a), about(Z, a[0]) * about(Y, a[1]) * about(X, a[2]));
  require_equal(of_euler("ZYX", a), about(X, a[2]) * about(Y, a[1]) * about(Z, a[0]));
}

BOOST_AUTO_TEST_CASE(quaternions_and_directions) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(0.3, -0.5, 0.7, 0.2).normalized();
  require_equal(of_quaternion(0.3, -0.5, 0.7, 0.2), q.matrix());
  const Vector3d d = Vector3d(1.0, -2.0, 0.5).normalized();
  require_equal(z_to(d), Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), d).matrix());
  BOOST_TEST((z_to(-Vector3d::UnitZ()) * Vector3d::UnitZ() + Vector3d::UnitZ()).norm() == 0.0);
}

// Two balls of 1 kg at a distance of 2 m: 2 kg m² about axes across.
BOOST_AUTO_TEST_CASE(a_body_of_two_parts) {
  const Inertia one{1.0, {1.0, 0.0, 0.0}, 0.1 * Matrix3d::Identity()};
  const Inertia other{1.0, {-1.0, 0.0, 0.0}, 0.1 * Matrix3d::Identity()};
  const Inertia both = one + other;
  BOOST_TEST(both.mass == 2.0);
  BOOST_TEST(both.center.norm() == 0.0);
  BOOST_TEST((both.about_center - Vector3d(0.2, 2.2, 2.2).asDiagonal().toDenseMatrix()).norm() <=
             1e-15);
}

BOOST_AUTO_TEST_CASE(a_turned_inertia) {
  const Inertia given{2.0, {1.0, 0.0, 0.0}, symmetric(1.0, 2.0, 3.0, 0.1, 0.2, 0.3)};
  const Inertia turned = Pose{of_rpy({0.0, 0.0, 0.5 * pi}), {0.0, 0.0, 1.0}} * given;
  BOOST_TEST((turned.center - Vector3d(0.0, 1.0, 1.0)).norm() == 0.0);
  // x is the old -y, y the old x.
  BOOST_TEST((turned.about_center - symmetric(2.0, 1.0, 3.0, -0.1, -0.3, 0.2)).norm() <= 1e-15);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant::robots
