#include "courant/integrators/maps/spherical_midpoint.hpp"

namespace courant {

SphericalMidpoint::SphericalMidpoint(std::shared_ptr<const Sphere> sphere)
    : DiscretizationMap("SphericalMidpoint", std::move(sphere)) {}

DiscretizationMap::PointPair<Expr> SphericalMidpoint::do_forward(const ExprVector& x,
                                                                 const ExprVector& v) const {
  const ExprVector half = Expr(0.5) * v;
  const ExprVector middle = sqrt(1.0 - half.squaredNorm()) * x;
  return {middle - half, middle + half};
}

DiscretizationMap::TangentVector<Expr> SphericalMidpoint::do_inverse(const ExprVector& x0,
                                                                     const ExprVector& x1) const {
  const ExprVector sum = x0 + x1;
  return {sum / sqrt(sum.squaredNorm()), x1 - x0};
}

DiscretizationMap::Displacement SphericalMidpoint::do_from_start(const ExprVector& x0,
                                                                 const ExprVector& w) const {
  const ExprVector toward = x0 + Expr(0.5) * w;
  const ExprVector middle = toward / sqrt(toward.squaredNorm());
  const ExprVector end = 2.0 * middle.dot(x0) * middle - x0;
  return {middle, end - x0, end};
}

}  // namespace courant
