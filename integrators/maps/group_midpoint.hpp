// The midpoint discretization map of a map of the Lie algebra, on groups of matrices.
#pragma once

#include "courant/integrators/maps/discretization_map.hpp"
#include "courant/manifolds/matrix_group.hpp"

namespace courant {

// R_d(x, v) = (x τ(-v/2), x τ(v/2)) with a map τ of the algebra to the group, such as cayley_map and
// second_kind_map, whatever retraction the group has. Symmetric, of order 2, left-invariant.
//
// The pairs that begin at x₀ are those of x = x₀ τ(-v/2)⁻¹. The inverse has no closed formula: it
// would need a root of x₀⁻¹ x₁.
class GroupMidpoint final : public DiscretizationMap {
 public:
  GroupMidpoint(std::shared_ptr<const MatrixGroup> group, const GroupMap& map);

  bool has_inverse() const override { return false; }
  bool has_start() const override { return true; }
  double domain_radius() const override { return radius_; }
  int order() const override { return 2; }
  bool is_symmetric() const override { return true; }
  bool is_left_invariant() const override { return true; }

 private:
  PointPair<Expr> do_forward(const ExprVector& x, const ExprVector& v) const override;
  Displacement do_from_start(const ExprVector& x0, const ExprVector& w) const override;

  double radius_;
  std::shared_ptr<const MatrixGroup> by_map_;  // the group, with τ for its retraction
};

}  // namespace courant
