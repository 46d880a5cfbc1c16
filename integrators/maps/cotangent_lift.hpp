// The cotangent lift of a discretization map.
#pragma once

#include "courant/integrators/maps/discretization_map.hpp"
#include "courant/manifolds/cotangent_bundle.hpp"

namespace courant {

// R_d^{T*} = Φ⁻¹ ∘ R̂_d ∘ α_Q: T(T*Q) → T*Q × T*Q for a discretization map R_d: TQ → Q × Q
// (Proposition 4.11): a symplectomorphism from (T(T*Q), d_Tω_Q) to (T*Q × T*Q, pr₂*ω_Q - pr₁*ω_Q)
// (Corollary 4.12), so that Hamiltonian and Lagrangian systems give symplectic methods. Here
//
//   α_Q: TT*Q → T*TQ, (q, p, q̇, ṗ) ↦ (q, v, p_q, p_v) = (q, q̇, ṗ, p)
//
// (the paper prints the inverse of α_Q).
//
// In coordinates (ṗ, p) = (T R_d)ᵀ(-p₀, p₁) at (q, v), R_d(q, v) = (q₀, q₁): the inverse needs no
// linear solve. In the frames of CotangentBundle, with T the torsion of the frame, it is made of the
// derivatives of one function,
//
//   φ(q, v) = -⟨p₀, C(q₀) R⁻(q, v)⟩ + ⟨p₁, C(q₁) R⁺(q, v)⟩
//   p = ∂_vφ,   ρ = ∂_qφ - ⟨p, T(v, ·)⟩
//
// forward solves the same equations, which are linear in (p₀, p₁).
class CotangentLift final : public DiscretizationMap {
 public:
  // `base` on the base manifold of `phase_space`; throws std::invalid_argument otherwise.
  CotangentLift(std::shared_ptr<const CotangentBundle> phase_space,
                std::shared_ptr<const DiscretizationMap> base);

  const std::shared_ptr<const DiscretizationMap>& base() const { return base_; }
  bool has_inverse() const override { return base_->has_inverse(); }
  bool has_start() const override { return base_->has_start(); }
  double domain_radius() const override { return base_->domain_radius(); }
  int order() const override { return base_->order(); }
  double stage_time() const override { return base_->stage_time(); }
  bool is_symmetric() const override { return base_->is_symmetric(); }
  std::optional<bool> is_symplectic() const override { return true; }

 private:
  PointPair<Expr> do_forward(const ExprVector& x, const ExprVector& v) const override;
  TangentVector<Expr> do_inverse(const ExprVector& x0, const ExprVector& x1) const override;
  Displacement do_from_start(const ExprVector& x0, const ExprVector& w) const override;
  // (q, q₀, q₁) with R_d(q, v) = (q₀, q₁) for the base, or on a group the same moved so that q is
  // the unit, where formulas are short: what the pull-back is computed at.
  struct Site {
    ExprVector q, q0, q1;
  };
  Site site(const ExprVector& q, const ExprVector& v, const ExprVector& q0,
            const ExprVector& q1) const;
  // R_d⁻¹(x₀, x₁), where that of the base is (q, v).
  TangentVector<Expr> lifted(const ExprVector& q, const ExprVector& v, const ExprVector& x0,
                             const ExprVector& x1) const;

  std::shared_ptr<const CotangentBundle> phase_space_;
  std::shared_ptr<const DiscretizationMap> base_;
};

}  // namespace courant
