// Rigid motions, and masses that they carry.
#pragma once

#include <Eigen/Core>
#include <string>

namespace courant::robots {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// x ↦ rotation x + position: a frame in another one.
struct Pose {
  Matrix3d rotation = Matrix3d::Identity();
  Vector3d position = Vector3d::Zero();

  Vector3d operator*(const Vector3d& point) const { return rotation * point + position; }
};
// The frame b, given in a, in that of a.
Pose operator*(const Pose& a, const Pose& b);
Pose inverse(const Pose& pose);
// Whether they agree to 1e-9 m and 1e-9 rad.
bool are_near(const Pose& a, const Pose& b);

// Right-handed turn by an angle in radians about an axis of length 1. Quarter turns about coordinate axes are exact.
Matrix3d turn(const Vector3d& axis, double angle);
// About the fixed axes x, y and z, in that order: Rz(yaw) Ry(pitch) Rx(roll).
Matrix3d of_rpy(const Vector3d& rpy);
// The angles of that, pitch in [-π/2, π/2]; where it is ±π/2, yaw is 0.
Vector3d rpy_of(const Matrix3d& rotation);
// Of a quaternion (w, x, y, z) of any length but 0.
Matrix3d of_quaternion(double w, double x, double y, double z);

// Three angles about axes `sequence` ("xyz", "ZYX", …): of the turned frame where letters are small, of the fixed one
// where they are capitals.
Matrix3d of_euler(const std::string& sequence, const Vector3d& angles);
// The least turn that takes the z axis to a direction of length 1.
Matrix3d z_to(const Vector3d& direction);

// A mass (kg), its centre (m), and its inertia about the centre (kg m²), all in one frame.
struct Inertia {
  double mass = 0.0;
  Vector3d center = Vector3d::Zero();
  Matrix3d about_center = Matrix3d::Zero();
};
// Given in a frame, in the one in which that frame is `pose`.
Inertia operator*(const Pose& pose, const Inertia& inertia);
// Of both bodies together.
Inertia operator+(const Inertia& a, const Inertia& b);
// The symmetric matrix of xx, yy, zz, xy, xz, yz.
Matrix3d symmetric(double xx, double yy, double zz, double xy, double xz, double yz);

// A number without the round-off of a few operations on numbers of size `scale`: 15 digits.
double tidy(double value, double scale);

}  // namespace courant::robots
