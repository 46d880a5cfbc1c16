// The graph of a two-form.
#pragma once

#include "courant/structures/dirac_structure.hpp"
#include "courant/structures/matrix_field.hpp"

namespace courant {

// D_ω = {(v, α) : α = ω♭(v)} with ω♭(u)(v) = ω(u, v): the graph of a two-form (Example 2.2.2,
// Theorem 2.4 with F = TM).
//
// ω(x) is the Ñ × Ñ skew-symmetric matrix ω_ij = ω(e_i, e_j) in the tangent representation, so
// α = ω(x)ᵀ v; where n < Ñ it is restricted to T_xM. Integrable if and only if dω = 0, when ω is a
// presymplectic form; of any rank.
class Presymplectic final : public DiracStructure {
 public:
  Presymplectic(std::shared_ptr<const Manifold> manifold, MatrixField form);

  Index tangent_blocks() const override { return 1; }

  ExprMatrix form(const ExprVector& x) const { return form_(x); }

 private:
  ExprVector do_membership(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                           const ExprVector& u) const override;
  MatrixField form_;
};

}  // namespace courant
