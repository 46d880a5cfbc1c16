// Two Dirac structures joined over shared ports.
#pragma once

#include "courant/manifolds/product.hpp"
#include "courant/structures/dirac_structure.hpp"

namespace courant {

// A ∘ B = {(v_A, α_A, v_B, α_B) : (v_A, f, α_A, e) ∈ A and (v_B, -f, α_B, e) ∈ B for some (f, e)}
// on M_A × M_B, for A on M_A × R^m and B on M_B × R^m whose last m coordinates are the ports, flow
// f and effort e; neither depends on the port coordinates (they are taken at 0).
//
// What leaves A enters B (f_A = -f_B) and efforts are common, so the power of the ports cancels:
// A ∘ B is Dirac at each point (Cervera, van der Schaft & Baños 2007). It is a smooth bundle only
// where the ranks that its elimination of (f, e) passes are constant: rank_profile reports points
// where they jump.
//
// A port-Hamiltonian system (J, B) with open ports is such an A: the bivector [J B; -Bᵀ 0] on
// M × R^m, with the input as effort e = u and f = -y the negative output.
class Composed final : public DiracStructure {
 public:
  // M_A and M_B are given since a manifold M_A × R^m does not tell its parts; throws
  // std::invalid_argument if sizes do not fit.
  Composed(std::shared_ptr<const DiracStructure> A, std::shared_ptr<const Manifold> M_A,
           std::shared_ptr<const DiracStructure> B, std::shared_ptr<const Manifold> M_B,
           Index shared);
  bool is_dirac() const override { return A_->is_dirac() && B_->is_dirac(); }

 private:
  ExprVector do_membership(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                           const ExprVector& u) const override;
  std::shared_ptr<const DiracStructure> A_, B_;
  std::shared_ptr<const Manifold> M_A_, M_B_;
  Index shared_;
};

}  // namespace courant
