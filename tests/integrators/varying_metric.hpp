// A particle in R⁴ with a varying metric and two constraints on its velocity, by hand.
#pragma once

#include <Eigen/LU>

namespace courant::varying_metric {

using Eigen::Matrix4d;
using Eigen::Vector2d;
using Eigen::Vector4d;
using Columns = Eigen::Matrix<double, 4, 2>;

// gⁱʲ = diag(1, 1/(1 + q₀²), 0.7, 1.2), V = ‖q‖²/2 + 0.3 q₀ q₁
inline Matrix4d inverse_metric(const Vector4d& q) {
  return Vector4d(1.0, 1.0 / (1.0 + q[0] * q[0]), 0.7, 1.2).asDiagonal();
}
inline Vector4d dH_dq(const Vector4d& q, const Vector4d& p) {
  const double s = 1.0 + q[0] * q[0];
  return q + Vector4d(0.3 * q[1] - q[0] * p[1] * p[1] / (s * s), 0.3 * q[0], 0.0, 0.0);
}
// μ¹ = dq₂ - q₁ dq₀, μ² = dq₃ - q₀ dq₁
inline Columns mu(const Vector4d& q) {
  Columns columns = Columns::Zero();
  columns.col(0) << -q[1], 0.0, 1.0, 0.0;
  columns.col(1) << 0.0, -q[0], 0.0, 1.0;
  return columns;
}
inline Vector2d constraints(const Vector4d& q, const Vector4d& p) {
  return mu(q).transpose() * inverse_metric(q) * p;
}

}  // namespace courant::varying_metric
