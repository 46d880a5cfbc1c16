// The Lie–Poisson structure of the dual of a Lie algebra.
#pragma once

#include <vector>

#include "courant/structures/dirac_structure.hpp"
#include "courant/structures/lie_algebra.hpp"

namespace courant {

// The graph of Λ_ij(μ) = ∓ Σ_k c^k_ij μ_k on g* = Rⁿ: {f, g}(μ) = ∓⟨μ, [df, dg]⟩.
//
// Minus is for left-invariant systems, in body coordinates: on so(3)* μ̇ = μ × ∂H/∂μ, the Euler
// equations; on se(3)* those of the heavy top and of the rigid body in a fluid. Integrable, since
// the Jacobi identity of Λ is that of g. Casimirs are what the coadjoint action keeps.
//
// Of a semidirect product g ⋉ V, (μ, a) ∈ (g ⋉ V)*, with ξ = α_μ
//
//   μ̇ = ±(ad*_ξ μ - ρ*_{α_a} a),   ȧ = ±ρ(ξ)ᵀ a
//
// and with the attitude x ∈ G besides, T*G × V* in the left trivialisation, of which (μ, a) is the
// quotient by G: minus α_x in μ̇, and ẋ = x ξ.
class LiePoisson final : public DiracStructure {
 public:
  enum class Sign { minus, plus };
  // On Euclidean(n), or on the given manifold, which has to be an open subset of Rⁿ (else
  // std::invalid_argument).
  explicit LiePoisson(const LieAlgebra& algebra, Sign sign = Sign::minus);
  LiePoisson(const LieAlgebra& algebra, std::shared_ptr<const Manifold> manifold,
             Sign sign = Sign::minus);
  // Of g ⋉ V with ρ_i = ρ(e_i), or of g where there are none; with the attitude if there is a
  // group. Throws std::domain_error unless ρ is a representation of g and g is the algebra of the
  // group (is_group_of), std::invalid_argument for a group with Sign::plus: what is right-invariant
  // has its attitude by right translation.
  LiePoisson(const LieAlgebra& g, std::vector<MatrixXd> rho, Sign sign = Sign::minus,
             std::shared_ptr<const Manifold> group = nullptr);

  const LieAlgebra& algebra() const { return algebra_; }                           // g ⋉ V
  const LieAlgebra& acting() const { return acting_; }                             // g
  const std::vector<MatrixXd>& representation() const { return representation_; }  // ρ
  Sign sign() const { return sign_; }
  const std::shared_ptr<const Manifold>& group() const { return group_; }  // or null
  // Λ at (μ, a) or (μ, a, x); Ñ × Ñ.
  ExprMatrix bivector(const ExprVector& mu) const;

 private:
  ExprVector do_membership(const ExprVector& mu, const ExprVector& v, const ExprVector& alpha,
                           const ExprVector& u) const override;
  LieAlgebra algebra_, acting_;
  std::vector<MatrixXd> representation_;
  Sign sign_;
  std::shared_ptr<const Manifold> group_;
};

}  // namespace courant
