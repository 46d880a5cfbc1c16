#include "courant/manifolds/special_euclidean3.hpp"

#include <numbers>

#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/manifolds/rotation.hpp"
#include "courant/manifolds/row_major.hpp"

namespace courant {
namespace {

ExprMatrix rotation_of_pose(const ExprVector& x) { return matrix_of(x.head(9), 3, 3); }

ExprVector composed(const ExprVector& x, const ExprMatrix& rotation_part,
                    const ExprVector& translation) {
  const ExprMatrix R = rotation_of_pose(x);
  return joined(vector_of(R * rotation_part), x.tail(3) + R * translation);
}

// The parts of x⁻¹ y.
ExprMatrix rotation_quotient(const ExprVector& x, const ExprVector& y) {
  return rotation_of_pose(x).transpose() * rotation_of_pose(y);
}
ExprVector translation_quotient(const ExprVector& x, const ExprVector& y) {
  return rotation_of_pose(x).transpose() * (y.tail(3) - x.tail(3));
}

}  // namespace

SpecialEuclidean3::SpecialEuclidean3(Retraction retraction)
    : Manifold("SpecialEuclidean3(" + retraction.name + ")", 6, 12, 6),
      retraction_(std::move(retraction)) {}

Retraction SpecialEuclidean3::exponential() {
  return {.name = "exponential",
          .map =
              [](const ExprVector& x, const ExprVector& v) {
                const ExprVector w = v.head(3);
                const ExprVector u = v.tail(3);
                const Expr s = w.squaredNorm();
                const ExprVector w_u = hat(w) * u;
                return composed(x, rotation_exponential(w),
                                u + stumpff(2, s) * w_u + stumpff(3, s) * (hat(w) * w_u));
              },
          .inverse =
              [](const ExprVector& x, const ExprVector& y) {
                const ExprVector w = rotation_logarithm(rotation_quotient(x, y));
                const ExprVector r = translation_quotient(x, y);
                const Expr s = w.squaredNorm();
                // (1 + c₂ ŵ + c₃ ŵ²)⁻¹ = 1 - ŵ/2 + (c₃ - 2 c₄)/(2 c₂) ŵ²
                const Expr factor = (stumpff(3, s) - 2.0 * stumpff(4, s)) / (2.0 * stumpff(2, s));
                const ExprVector w_r = hat(w) * r;
                return joined(w, r - Expr(0.5) * w_r + factor * (hat(w) * w_r));
              },
          .injectivity_radius = std::numbers::pi,
          .is_geodesic = true,
          .is_left_invariant = true,
          .velocity = [](const ExprVector&, const ExprVector& v, const Expr&) { return v; }};
}

Retraction SpecialEuclidean3::cayley() {
  return {.name = "cayley",
          .map =
              [](const ExprVector& x, const ExprVector& v) {
                const ExprVector w = v.head(3);
                const ExprVector u = v.tail(3);
                // (1 - ŵ/2)⁻¹ = (1 + cay ŵ)/2
                return composed(x, rotation_cayley(w), Expr(0.5) * (u + rotation_cayley(w) * u));
              },
          .inverse =
              [](const ExprVector& x, const ExprVector& y) {
                const ExprVector w = rotation_inverse_cayley(rotation_quotient(x, y));
                const ExprVector r = translation_quotient(x, y);
                return joined(w, r - Expr(0.5) * (hat(w) * r));
              },
          .is_left_invariant = true};
}

ExprVector SpecialEuclidean3::do_retract(const ExprVector& x, const ExprVector& v) const {
  return retraction_.map(x, v);
}

ExprVector SpecialEuclidean3::do_inverse_retract(const ExprVector& x, const ExprVector& y) const {
  return retraction_.inverse(x, y);
}

std::optional<VectorXd> SpecialEuclidean3::do_unit() const {
  if (!retraction_.is_left_invariant) return std::nullopt;
  VectorXd unit = VectorXd::Zero(ambient_dimension());
  unit[0] = unit[4] = unit[8] = 1.0;
  return unit;
}

ExprVector SpecialEuclidean3::do_velocity_along(const ExprVector& x, const ExprVector& v,
                                                const Expr& s) const {
  return retraction_.velocity ? retraction_.velocity(x, v, s) : differentiated_velocity(x, v, s);
}

ExprMatrix SpecialEuclidean3::do_frame(const ExprVector& x) const {
  ExprMatrix result = ExprMatrix::Zero(12, 6);
  result.topLeftCorner(9, 3) = rotations_.frame(x.head(9)).matrix();
  result.bottomRightCorner(3, 3) = rotation_of_pose(x);
  return result;
}

ExprMatrix SpecialEuclidean3::do_coframe(const ExprVector& x) const {
  ExprMatrix result = ExprMatrix::Zero(6, 12);
  result.topLeftCorner(3, 9) = rotations_.coframe(x.head(9)).matrix();
  result.bottomRightCorner(3, 3) = rotation_of_pose(x).transpose();
  return result;
}

ExprVector SpecialEuclidean3::do_constraint(const ExprVector& x) const {
  return rotations_.constraint(x.head(9));
}

double SpecialEuclidean3::do_injectivity_radius(const VectorXd&) const {
  return retraction_.injectivity_radius;
}

VectorXd SpecialEuclidean3::do_project(const VectorXd& x) const {
  VectorXd result(12);
  result << rotations_.project(x.head(9)), x.tail(3);
  return result;
}

VectorXd SpecialEuclidean3::do_random_point(std::mt19937& generator) const {
  std::normal_distribution<double> normal;
  VectorXd result(12);
  result << rotations_.random_point(generator),
      VectorXd::NullaryExpr(3, [&] { return normal(generator); });
  return result;
}

}  // namespace courant
