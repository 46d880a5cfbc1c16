// The rotation group of Rⁿ.
#pragma once

#include "courant/manifolds/manifold.hpp"

namespace courant {

// SO(n) = {X ∈ R^{n×n} : XᵀX = 1, det X = 1}, left-trivialised, for any n ≥ 1.
//
//   point      X ∈ R^{n²}, row after row                        N = n²
//   tangent    v ∈ R^{n(n-1)/2} with Ẋ = X V, V = Σ_{i<j} v_ij E_ij, E_ij = e_i e_jᵀ - e_j e_iᵀ,
//              in the order (0,1), (0,2), …, (1,2), … of LieAlgebra::so
//   covector   its dual: the angular momentum in the body       dimension = Ñ = n(n-1)/2
//   frame      E v = X V,   C Ẋ the entries (i, j), i < j, of the skew part of XᵀẊ
//
// The retraction is X cay V, cay V = (1 - V/2)⁻¹(1 + V/2), injective for all v. It misses where
// X⁻¹Y has the eigenvalue -1, where its inverse V = 2 (1 + X⁻¹Y)⁻¹(X⁻¹Y - 1) is not finite. For n = 3
// SpecialOrthogonal3 has angular velocities as vectors, and the exponential.
class SpecialOrthogonal final : public Manifold {
 public:
  // Throws std::invalid_argument for n < 1.
  explicit SpecialOrthogonal(Index n);

  Index size() const { return n_; }  // n

 private:
  bool do_equals(const Manifold& other) const override { return other.name() == name(); }
  ExprVector do_retract(const ExprVector& x, const ExprVector& v) const override;
  ExprVector do_inverse_retract(const ExprVector& x, const ExprVector& y) const override;
  std::optional<VectorXd> do_unit() const override;
  ExprMatrix do_frame(const ExprVector& x) const override;
  ExprMatrix do_coframe(const ExprVector& x) const override;
  ExprVector do_constraint(const ExprVector& x) const override;
  // Reflections satisfy the constraint, and are no points.
  double do_point_defect(const VectorXd& x) const override;
  VectorXd do_project(const VectorXd& x) const override;
  VectorXd do_random_point(std::mt19937& generator) const override;

  Index n_;
};

}  // namespace courant
