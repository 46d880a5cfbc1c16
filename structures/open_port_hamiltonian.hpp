// The structure of a port-Hamiltonian system with open ports.
#pragma once

#include "courant/structures/dirac_structure.hpp"
#include "courant/structures/matrix_field.hpp"

namespace courant {

// D_{𝒟,B} = {(v, α) : v = J(x) α + B(x) u for some u ∈ R^m} (equation (22), where "∀ u" is an
// erratum for "∃ u"): coisotropic, and Dirac only where B = 0 (Proposition 7.1):
//
//   D^⊥ = {(v, α) : v = J α, Bᵀα = 0} ⊂ D,   dim D_x = n + rank B(x)
//
// J(x): Ñ × Ñ, skew, with range in T_xM; B(x): Ñ × m, columns tangent. u are the flows (inputs) of
// the ports, y = Bᵀα their efforts (outputs); the power that enters is ⟨y, u⟩ = ⟨α, v⟩.
class OpenPortHamiltonian final : public DiracStructure {
 public:
  OpenPortHamiltonian(std::shared_ptr<const Manifold> manifold, MatrixField interconnection,
                      Index m, MatrixField input);

  bool is_dirac() const override { return port_size() == 0; }
  Index tangent_blocks() const override { return 1; }

  // y = B(x)ᵀ α, size m.
  ExprVector output(const ExprVector& x, const ExprVector& alpha) const;

 private:
  ExprVector do_membership(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                           const ExprVector& u) const override;
  MatrixField interconnection_;
  MatrixField input_;
};

}  // namespace courant
