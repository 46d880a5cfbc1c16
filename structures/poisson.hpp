// The graph of a bivector.
#pragma once

#include "courant/structures/dirac_structure.hpp"
#include "courant/structures/matrix_field.hpp"

namespace courant {

// D_Λ = {(v, α) : v = ♯_Λ(α)} with ⟨β, ♯_Λ(α)⟩ = Λ(β, α): the graph of a bivector (Example 2.2.3,
// Theorem 2.5 with F^(*) = T*M).
//
// Λ(x) is the Ñ × Ñ matrix of ♯ in the tangent representation: v = Λ(x) α; skew-symmetric, with
// range in T_xM. A Poisson structure if the Schouten bracket [Λ, Λ] vanishes; the graph is a Dirac
// structure in any case.
class Poisson final : public DiracStructure {
 public:
  using Bivector = MatrixField;
  Poisson(std::shared_ptr<const Manifold> manifold, Bivector bivector);

  ExprMatrix bivector(const ExprVector& x) const { return bivector_(x); }

  Index tangent_blocks() const override { return 1; }

 private:
  ExprVector do_membership(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                           const ExprVector& u) const override;
  Bivector bivector_;
};

}  // namespace courant
