// Groups of matrices.
#pragma once

#include <functional>

#include "courant/manifolds/group_map.hpp"
#include "courant/manifolds/manifold.hpp"
#include "courant/manifolds/matrix_algebra.hpp"

namespace courant {

// The group G of invertible m × m matrices that the exp v̂ of a Lie algebra generate, left-trivialised.
//
//   point      X as x ∈ R^N (MatrixAlgebra::Coordinates), all entries row after row where nothing else is said
//   tangent    v ∈ Rⁿ with Ẋ = X v̂                 n = Ñ
//   covector   in (Rⁿ)*
//   frame      E v = X v̂,   C Ẋ = (X⁻¹ Ẋ)^∨
//
// Retraction: x ↦ x τ(v) with a map τ of the algebra to the group: exponential_map (geodesic),
// cayley_map or second_kind_map.
//
// Equations are those that MatrixAlgebra finds and those that are given. Where they have more components than G (O(n)
// for SO(n)), points with a negative determinant are outside; other components are not told apart.
class MatrixGroup final : public Manifold {
 public:
  // Further equations c(x) = 0 of G, in the coordinates of points.
  using Equations = std::function<ExprVector(const ExprVector& x)>;

  // By default with the exponential map. Throws std::domain_error unless the equations hold on G and
  // have N - n independent gradients there.
  explicit MatrixGroup(const MatrixAlgebra& algebra);
  MatrixGroup(MatrixAlgebra algebra, GroupMap map, Equations equations = {});

  const MatrixAlgebra& algebra() const { return algebra_; }
  // The same group with another retraction.
  std::shared_ptr<const MatrixGroup> with(GroupMap map) const;

  bool has_inverse() const override { return static_cast<bool>(map_.inverse); }
  bool is_geodesic() const override { return map_.is_exponential; }
  bool has_source() const override { return true; }

 private:
  bool do_equals(const Manifold& other) const override;
  ExprVector do_retract(const ExprVector& x, const ExprVector& v) const override;
  ExprVector do_inverse_retract(const ExprVector& x, const ExprVector& y) const override;
  ExprVector do_source(const ExprVector& y, const ExprVector& v) const override;
  std::optional<VectorXd> do_unit() const override;
  ExprVector do_velocity_along(const ExprVector& x, const ExprVector& v,
                               const Expr& s) const override;
  ExprMatrix do_frame(const ExprVector& x) const override;
  ExprMatrix do_coframe(const ExprVector& x) const override;
  ExprVector do_constraint(const ExprVector& x) const override;
  double do_point_defect(const VectorXd& x) const override;
  double do_injectivity_radius(const VectorXd&) const override { return map_.injectivity_radius; }
  Extent do_extent_at(const VectorXd&) const override { return map_.extent; }
  VectorXd do_random_point(std::mt19937& generator) const override;

  MatrixAlgebra algebra_;
  GroupMap map_;
  Equations equations_;
};

}  // namespace courant
