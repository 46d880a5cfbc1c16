// The structure of a port-Hamiltonian system with closed ports.
#pragma once

#include "courant/structures/dirac_structure.hpp"
#include "courant/structures/matrix_field.hpp"

namespace courant {

// D^(c) = {(v, α) : v = J(x) α + B(x) u for some u ∈ R^m, B(x)ᵀ α = 0} (equation (23)): a Dirac
// structure (Proposition 7.1), the restriction of the bivector J to the annihilator of the columns
// of B (Theorem 2.5).
//
// J(x): Ñ × Ñ, skew, with range in T_xM; B(x): Ñ × m, columns tangent.
class ClosedPortHamiltonian final : public DiracStructure {
 public:
  ClosedPortHamiltonian(std::shared_ptr<const Manifold> manifold, MatrixField interconnection,
                        Index m, MatrixField input);
  Index tangent_blocks() const override { return 1; }

 private:
  ExprVector do_membership(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                           const ExprVector& u) const override;
  MatrixField interconnection_;
  MatrixField input_;
};

}  // namespace courant
