// The Lie–Poisson structure of the dual of a Lie algebra.
#pragma once

#include "courant/structures/dirac_structure.hpp"
#include "courant/structures/lie_algebra.hpp"

namespace courant {

// The graph of Λ_ij(μ) = ∓ Σ_k c^k_ij μ_k on g* = Rⁿ: {f, g}(μ) = ∓⟨μ, [df, dg]⟩.
//
// Minus is for left-invariant systems, in body coordinates: on so(3)* μ̇ = μ × ∂H/∂μ, the Euler
// equations; on se(3)* those of the heavy top and of the rigid body in a fluid. Integrable, since
// the Jacobi identity of Λ is that of g. Casimirs are what the coadjoint action keeps.
class LiePoisson final : public DiracStructure {
 public:
  enum class Sign { minus, plus };
  // On Euclidean(n), or on the given manifold, which has to be an open subset of Rⁿ (else
  // std::invalid_argument).
  explicit LiePoisson(const LieAlgebra& algebra, Sign sign = Sign::minus);
  LiePoisson(const LieAlgebra& algebra, std::shared_ptr<const Manifold> manifold,
             Sign sign = Sign::minus);

  const LieAlgebra& algebra() const { return algebra_; }
  ExprMatrix bivector(const ExprVector& mu) const;

 private:
  ExprVector do_membership(const ExprVector& mu, const ExprVector& v, const ExprVector& alpha,
                           const ExprVector& u) const override;
  LieAlgebra algebra_;
  Sign sign_;
};

}  // namespace courant
