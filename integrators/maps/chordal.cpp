#include "courant/integrators/maps/chordal.hpp"

namespace courant {
namespace {

ExprVector normalised(const ExprVector& x) { return x * (1.0 / sqrt(x.squaredNorm())); }

}  // namespace

Chordal::Chordal(std::shared_ptr<const Sphere> sphere)
    : DiscretizationMap("Chordal", std::move(sphere)) {}

DiscretizationMap::PointPair<Expr> Chordal::do_forward(const ExprVector& x,
                                                       const ExprVector& v) const {
  const ExprVector half = Expr(0.5) * v;
  return {normalised(x - half), normalised(x + half)};
}

DiscretizationMap::TangentVector<Expr> Chordal::do_inverse(const ExprVector& x0,
                                                           const ExprVector& x1) const {
  const Expr length = sqrt((x0 + x1).squaredNorm());
  return {(x0 + x1) / length, Expr(2.0) * (x1 - x0) / length};
}

DiscretizationMap::Displacement Chordal::do_from_start(const ExprVector& x0,
                                                       const ExprVector& w) const {
  // The middle m = s/‖s‖ of the chord's arc, then x₁ as the reflection of x₀ in it.
  const ExprVector s = x0 + Expr(0.5) * w;
  const Expr length = sqrt(s.squaredNorm());
  const Expr along = s.dot(x0);
  const ExprVector middle = s * (1.0 / length);
  return {middle, Expr(2.0) * (middle - length / along * x0), 2.0 * along / length * middle - x0};
}

}  // namespace courant
