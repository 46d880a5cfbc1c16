// The canonical symplectic structure of a cotangent bundle.
#pragma once

#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/structures/dirac_structure.hpp"

namespace courant {

// The graph of ω_Q on T*Q for any Q: D = {(X, α) : i_X ω_Q = α}, ω_Q = dq ∧ dp in coordinates
// (Example 5.5).
//
// With X = (v, ρ) and α = (α_q, α_p) in the frames of CotangentBundle:
//   v = α_p,   ρ + ⟨p, T(v, ·)⟩ = -α_q
// where T is the torsion of the frame: zero on vector spaces and spheres, on a Lie group it gives
// the ad* of the Euler equations.
class CanonicalSymplectic final : public DiracStructure {
 public:
  explicit CanonicalSymplectic(std::shared_ptr<const CotangentBundle> phase_space);

  bool is_canonical() const override { return true; }
  Index tangent_blocks() const override { return 1; }
  // ω at a point x of T*Q, ω_ij = ω(e_i, e_j) (2Ñ × 2Ñ), and the bivector whose graph D is as well:
  // α = ωᵀ v, v = Λ α.
  ExprMatrix form(const ExprVector& x) const;
  ExprMatrix bivector(const ExprVector& x) const;

 private:
  ExprVector do_membership(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                           const ExprVector& u) const override;
  ExprMatrix torsion(const ExprVector& x) const;
  std::shared_ptr<const CotangentBundle> phase_space_;
};

}  // namespace courant
