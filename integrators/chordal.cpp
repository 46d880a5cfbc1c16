#include "courant/integrators/chordal.hpp"

namespace courant {
namespace {

ExprVector normalised(const ExprVector& x) { return x / sqrt(x.squaredNorm()); }

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

}  // namespace courant
