#include "courant/integrators/maps/cayley_midpoint.hpp"

#include "courant/manifolds/rotation.hpp"
#include "courant/manifolds/row_major.hpp"

namespace courant {

CayleyMidpoint::CayleyMidpoint(std::shared_ptr<const SpecialOrthogonal3> group)
    : DiscretizationMap("CayleyMidpoint", std::move(group)),
      cayley_(std::make_shared<SpecialOrthogonal3>(SpecialOrthogonal3::cayley())) {}

CayleyMidpoint::CayleyMidpoint(std::shared_ptr<const SpecialEuclidean3> group)
    : DiscretizationMap("CayleyMidpoint", std::move(group)),
      cayley_(std::make_shared<SpecialEuclidean3>(SpecialEuclidean3::cayley())) {}

CayleyMidpoint::CayleyMidpoint(std::shared_ptr<const SpecialOrthogonal> group)
    : DiscretizationMap("CayleyMidpoint", group), has_root_(false), cayley_(group) {}

DiscretizationMap::PointPair<Expr> CayleyMidpoint::do_forward(const ExprVector& x,
                                                              const ExprVector& v) const {
  return {cayley_->retract(x, ExprVector(Expr(-0.5) * v)),
          cayley_->retract(x, ExprVector(Expr(0.5) * v))};
}

DiscretizationMap::TangentVector<Expr> CayleyMidpoint::do_inverse(const ExprVector& x0,
                                                                  const ExprVector& x1) const {
  const ExprMatrix R0 = matrix_of(x0.head(9), 3, 3);
  const ExprMatrix R1 = matrix_of(x1.head(9), 3, 3);
  const ExprVector q = quaternion(R0.transpose() * R1);
  ExprVector v(manifold()->tangent_dimension());
  v.head(3) = 4.0 / (1.0 + q[0]) * q.tail(3);
  if (v.size() == 6) {
    const ExprMatrix root = ExprMatrix::Identity(3, 3) - Expr(0.25) * hat(v.head(3));
    v.tail(3) = root * (root * (R0.transpose() * (x1.tail(3) - x0.tail(3))));
  }
  return {cayley_->retract(x0, ExprVector(Expr(0.5) * v)), v};
}

DiscretizationMap::Displacement CayleyMidpoint::do_from_start(const ExprVector& x0,
                                                              const ExprVector& w) const {
  const ExprVector half = Expr(0.5) * w;
  const ExprVector middle = cayley_->retract(x0, half);
  return {middle, w, cayley_->retract(middle, half)};
}

}  // namespace courant
