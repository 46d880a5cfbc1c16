// A two-form restricted to a distribution.
#pragma once

#include "courant/structures/dirac_structure.hpp"
#include "courant/structures/matrix_field.hpp"

namespace courant {

// D_{ω_F} = {(v, α) : v ∈ F, α(w) = ω(v, w) for all w ∈ F} (Theorem 2.4), for a two-form ω and a
// regular distribution F = {v : ⟨μ^a, v⟩ = 0}. It is the only Dirac structure with F_D = F and
// ω_D = ω_F.
//
//   ⟨μ^a(x), v⟩ = 0,   α = ω(x)ᵀ v + μ(x) λ       multipliers λ ∈ R^m
//
// ω(x): Ñ × Ñ, ω_ij = ω(e_i, e_j), skew; μ(x): Ñ × m, one-forms in columns. With ω the canonical
// form of T*Q and μ constraints on q̇ it is the structure of nonholonomic mechanics (Section 8).
class RestrictedTwoForm final : public DiracStructure {
 public:
  RestrictedTwoForm(std::shared_ptr<const Manifold> manifold, MatrixField form, Index m,
                    MatrixField one_forms);
  Index tangent_blocks() const override { return 1; }

 private:
  ExprVector do_membership(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                           const ExprVector& u) const override;
  MatrixField form_;
  MatrixField one_forms_;
};

}  // namespace courant
