#include "courant/manifolds/special_orthogonal3.hpp"

#include <numbers>

#include "courant/manifolds/rotation.hpp"
#include "courant/manifolds/row_major.hpp"

namespace courant {
namespace {

ExprMatrix rotation(const ExprVector& x) { return matrix_of(x, 3, 3); }

// x⁻¹ y
ExprMatrix quotient(const ExprVector& x, const ExprVector& y) {
  return rotation(x).transpose() * rotation(y);
}

}  // namespace

SpecialOrthogonal3::SpecialOrthogonal3(Retraction retraction)
    : Manifold("SpecialOrthogonal3(" + retraction.name + ")", 3, 9, 3),
      retraction_(std::move(retraction)) {}

Retraction SpecialOrthogonal3::exponential() {
  return {
      .name = "exponential",
      .map = [](const ExprVector& x,
                const ExprVector& v) { return vector_of(rotation(x) * rotation_exponential(v)); },
      .inverse = [](const ExprVector& x,
                    const ExprVector& y) { return rotation_logarithm(quotient(x, y)); },
      .injectivity_radius = std::numbers::pi,
      .is_geodesic = true,
      .is_left_invariant = true,
      .velocity = [](const ExprVector&, const ExprVector& v, const Expr&) { return v; }};
}

Retraction SpecialOrthogonal3::cayley() {
  return {.name = "cayley",
          .map = [](const ExprVector& x,
                    const ExprVector& v) { return vector_of(rotation(x) * rotation_cayley(v)); },
          .inverse = [](const ExprVector& x,
                        const ExprVector& y) { return rotation_inverse_cayley(quotient(x, y)); },
          .is_left_invariant = true};
}

ExprVector SpecialOrthogonal3::do_retract(const ExprVector& x, const ExprVector& v) const {
  return retraction_.map(x, v);
}

ExprVector SpecialOrthogonal3::do_inverse_retract(const ExprVector& x, const ExprVector& y) const {
  return retraction_.inverse(x, y);
}

std::optional<VectorXd> SpecialOrthogonal3::do_unit() const {
  if (!retraction_.is_left_invariant) return std::nullopt;
  VectorXd unit = VectorXd::Zero(ambient_dimension());
  unit[0] = unit[4] = unit[8] = 1.0;
  return unit;
}

ExprVector SpecialOrthogonal3::do_velocity_along(const ExprVector& x, const ExprVector& v,
                                                 const Expr& s) const {
  return retraction_.velocity ? retraction_.velocity(x, v, s) : differentiated_velocity(x, v, s);
}

ExprMatrix SpecialOrthogonal3::do_frame(const ExprVector& x) const {
  ExprMatrix result(9, 3);
  for (Index j = 0; j < 3; ++j)
    result.col(j) = vector_of(rotation(x) * hat(ExprVector::Unit(3, j)));
  return result;
}

ExprMatrix SpecialOrthogonal3::do_coframe(const ExprVector& x) const {
  return Expr(0.5) *
         do_frame(x).transpose();  // the columns of the frame are orthogonal, of length √2
}

// Two orthonormal rows and their cross product: no reflections, and six independent equations.
ExprVector SpecialOrthogonal3::do_constraint(const ExprVector& x) const {
  const ExprVector a = x.head(3);
  const ExprVector b = x.segment(3, 3);
  ExprVector result(6);
  result << a.squaredNorm() - 1.0, b.squaredNorm() - 1.0, a.dot(b), x.tail(3) - hat(a) * b;
  return result;
}

double SpecialOrthogonal3::do_injectivity_radius(const VectorXd&) const {
  return retraction_.injectivity_radius;
}

VectorXd SpecialOrthogonal3::do_project(const VectorXd& x) const {
  return nearest_rotation(x.reshaped<Eigen::RowMajor>(3, 3)).reshaped<Eigen::RowMajor>();
}

VectorXd SpecialOrthogonal3::do_random_point(std::mt19937& generator) const {
  std::normal_distribution<double> normal;
  const VectorXd q = VectorXd::NullaryExpr(4, [&] { return normal(generator); }).normalized();
  return values(vector_of(rotation_of(constants(q))));
}

}  // namespace courant
