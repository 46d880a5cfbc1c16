// The symmetric positive definite matrices.
#pragma once

#include "courant/manifolds/manifold.hpp"

namespace courant {

// SPD(n) = {X ∈ R^{n×n} : Xᵀ = X, X > 0}, n ≥ 0, an open subset of R^{n(n+1)/2}.
//
//   points, tangent vectors: the lower triangle, row after row: X₀₀, X₁₀, X₁₁, X₂₀, …
//   covectors: dual to those entries;   n(n+1)/2 = dim = N = Ñ,   E = C = 1
//
// Retraction: the geodesics of the log-Cholesky metric. With the Cholesky factor L of X and the
// tangent vector A = L(L⁻¹V L⁻ᵀ)_½ of L that V is ( _½ : lower triangle, half the diagonal),
//
//   R_X(V) = L⁺L⁺ᵀ,   L⁺ᵢⱼ = Lᵢⱼ + Aᵢⱼ (i > j),   L⁺ᵢᵢ = Lᵢᵢ exp(Aᵢᵢ/Lᵢᵢ),
//
// a diffeomorphism of T_XM onto SPD(n), with the inverse in the same closed form. Not invariant
// under X ↦ GXGᵀ. Outside the manifold not a number. Reference: Z. Lin, Riemannian geometry of
// symmetric positive definite matrices via Cholesky decomposition (2019).
class SymmetricPositiveDefinite final : public Manifold {
 public:
  // Throws std::invalid_argument unless n ≥ 0.
  explicit SymmetricPositiveDefinite(Index n);
  bool is_geodesic() const override { return true; }

 private:
  bool do_equals(const Manifold& other) const override { return other.name() == name(); }
  ExprVector do_retract(const ExprVector& x, const ExprVector& v) const override;
  ExprVector do_inverse_retract(const ExprVector& x, const ExprVector& y) const override;
  ExprMatrix do_frame(const ExprVector& x) const override;
  ExprMatrix do_coframe(const ExprVector& x) const override { return do_frame(x); }
  double do_point_defect(const VectorXd& x) const override;
  VectorXd do_project(const VectorXd& x) const override;
  VectorXd do_random_point(std::mt19937& generator) const override;

  Index n_;
};

}  // namespace courant
