// The cotangent bundle of any manifold.
#pragma once

#include "courant/manifolds/vector_bundle.hpp"

namespace courant {

// T*Q = {(q, p) : q ∈ Q, p ∈ T*_qQ}, of dimension 2n.
//
//   point      (q, p) ∈ R^{N+Ñ}          p in the covector representation of Q, p = Π(q)ᵀ p
//   tangent    (v, ρ) ∈ R^{2Ñ}           v = C(q) q̇,  ρ = Π(q)ᵀ ṗ
//   covector   (α_q, α_p) ∈ (R^{2Ñ})*
//
// Frames, retraction and its domain as in VectorBundle, with the fibre projector F = Πᵀ. Where
// n = Ñ (vector spaces, Lie groups) simply ṗ = ρ and R((q, p), (v, ρ)) = (R_q(v), p + ρ).
//
// The canonical forms in frames: θ = ⟨p, C(q) dq⟩ and ω = -dθ,
//   ω((v₁,ρ₁), (v₂,ρ₂)) = ⟨ρ₂,v₁⟩ - ⟨ρ₁,v₂⟩ - ⟨p, T(v₁,v₂)⟩
// with the torsion of the frame T(v,w) = dC(q; E v) E w - dC(q; E w) E v: zero on spheres, -[v,w]
// on a Lie group with the left trivialisation. In coordinates ω = dq ∧ dp.
class CotangentBundle final : public VectorBundle {
 public:
  explicit CotangentBundle(std::shared_ptr<const Manifold> base)
      : VectorBundle("CotangentBundle", std::move(base)) {}

  // p of a point (q, p).
  template <class X>
  auto momentum(const Eigen::MatrixBase<X>& x) const {
    return fibre_part(x);
  }

  // The covector w ↦ ⟨p, T(v, w)⟩ on T_qQ (size Ñ): what the torsion of the frame adds to
  // Hamilton's equations.
  ExprVector torsion(const ExprVector& q, const ExprVector& p, const ExprVector& v) const;

 private:
  LinearMap<Expr> fibre_projector(const ExprVector& q) const override {
    return base()->tangent_projector(q).transpose();
  }
};

}  // namespace courant
