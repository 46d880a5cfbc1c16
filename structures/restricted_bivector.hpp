// A bivector restricted to a codistribution.
#pragma once

#include "courant/structures/dirac_structure.hpp"
#include "courant/structures/matrix_field.hpp"

namespace courant {

// D_{Λ_{F^(*)}} = {(v, α) : α ∈ F^(*), β(v) = Λ(β, α) for all β ∈ F^(*)} (Theorem 2.5), for a
// bivector Λ and a regular codistribution F^(*) = {α : ⟨α, X_a⟩ = 0, a = 1 … k}, the annihilator of
// vector fields X_a:
//
//   v = Λ(x) α + X(x) λ,   X(x)ᵀ α = 0              multipliers λ ∈ R^k
//
// Λ(x): Ñ × Ñ, skew, with range in T_xM; X(x): Ñ × k, fields in columns. The same set as that of a
// closed port-Hamiltonian system with J = Λ, B = X (equation (23)).
class RestrictedBivector final : public DiracStructure {
 public:
  RestrictedBivector(std::shared_ptr<const Manifold> manifold, MatrixField bivector, Index k,
                     MatrixField fields);
  Index tangent_blocks() const override { return 1; }

 private:
  ExprVector do_membership(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                           const ExprVector& u) const override;
  MatrixField bivector_;
  MatrixField fields_;
};

}  // namespace courant
