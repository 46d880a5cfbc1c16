#include "courant/extensions/robots/pose.hpp"

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

namespace courant::robots {
namespace {

// Below this, sine and cosine of a double next to a multiple of π/2 are the round-off of the angle.
constexpr double kRoundOff = 4e-16;

double without_round_off(double value) {
  if (std::abs(value) < kRoundOff) return 0.0;
  if (std::abs(std::abs(value) - 1.0) < kRoundOff) return value > 0.0 ? 1.0 : -1.0;
  return value;
}

}  // namespace

Pose operator*(const Pose& a, const Pose& b) {
  return {a.rotation * b.rotation, a.rotation * b.position + a.position};
}

Pose inverse(const Pose& pose) {
  const Matrix3d back = pose.rotation.transpose();
  return {back, -(back * pose.position)};
}

bool are_near(const Pose& a, const Pose& b) {
  constexpr double near = 1e-9;
  return (a.rotation - b.rotation).cwiseAbs().maxCoeff() < near &&
         (a.position - b.position).cwiseAbs().maxCoeff() < near;
}

Matrix3d turn(const Vector3d& axis, double angle) {
  const double c = without_round_off(std::cos(angle)), s = without_round_off(std::sin(angle));
  Matrix3d cross;
  cross << 0.0, -axis[2], axis[1], axis[2], 0.0, -axis[0], -axis[1], axis[0], 0.0;
  return c * Matrix3d::Identity() + s * cross + (1.0 - c) * (axis * axis.transpose());
}

Matrix3d of_rpy(const Vector3d& rpy) { return of_euler("XYZ", rpy); }

Vector3d rpy_of(const Matrix3d& rotation) {
  const double horizontal = std::hypot(rotation(0, 0), rotation(1, 0));
  const double pitch = std::atan2(-rotation(2, 0), horizontal);
  if (horizontal < 1e-12) return {std::atan2(-rotation(1, 2), rotation(1, 1)), pitch, 0.0};
  return {std::atan2(rotation(2, 1), rotation(2, 2)), pitch,
          std::atan2(rotation(1, 0), rotation(0, 0))};
}

Matrix3d of_quaternion(double w, double x, double y, double z) {
  const double n = w * w + x * x + y * y + z * z;
  Matrix3d rotation;
  rotation << w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y),  //
      2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x),          //
      2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z;
  return (rotation / n).unaryExpr([](double entry) { return without_round_off(entry); });
}

Matrix3d of_euler(const std::string& sequence, const Vector3d& angles) {
  Matrix3d rotation = Matrix3d::Identity();
  for (std::size_t i = 0; i < 3; ++i) {
    const bool is_fixed = std::isupper(static_cast<unsigned char>(sequence[i])) != 0;
    const Vector3d axis =
        Vector3d::Unit(std::tolower(static_cast<unsigned char>(sequence[i])) - 'x');
    const Matrix3d one = turn(axis, angles[static_cast<Eigen::Index>(i)]);
    rotation = is_fixed ? Matrix3d(one * rotation) : Matrix3d(rotation * one);
  }
  return rotation;
}

Matrix3d z_to(const Vector3d& direction) {
  const Vector3d axis(-direction[1], direction[0], 0.0);  // z × direction
  const double sine = axis.norm();
  if (sine == 0.0)
    return direction[2] > 0.0 ? Matrix3d(Matrix3d::Identity())
                              : turn(Vector3d::UnitX(), std::acos(-1.0));
  return turn(axis / sine, std::atan2(sine, direction[2]));
}

Inertia operator*(const Pose& pose, const Inertia& inertia) {
  return {inertia.mass, pose * inertia.center,
          pose.rotation * inertia.about_center * pose.rotation.transpose()};
}

Inertia operator+(const Inertia& a, const Inertia& b) {
  if (a.mass == 0.0 && a.about_center.isZero(0.0)) return b;
  if (b.mass == 0.0 && b.about_center.isZero(0.0)) return a;
  const double mass = a.mass + b.mass;
  const Vector3d center =
      mass == 0.0 ? Vector3d(a.center) : Vector3d((a.mass * a.center + b.mass * b.center) / mass);
  Inertia sum{mass, center, a.about_center + b.about_center};
  for (const Inertia* one : {&a, &b}) {
    const Vector3d d = one->center - center;
    sum.about_center += one->mass * (d.squaredNorm() * Matrix3d::Identity() - d * d.transpose());
  }
  return sum;
}

Matrix3d symmetric(double xx, double yy, double zz, double xy, double xz, double yz) {
  Matrix3d matrix;
  matrix << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  return matrix;
}

double tidy(double value, double scale) {
  if (std::abs(value) <= 1e-15 * scale) return 0.0;
  std::array<char, 32> text;
  const auto written =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 15);
  std::from_chars(text.data(), written.ptr, value);
  return value;
}

}  // namespace courant::robots
