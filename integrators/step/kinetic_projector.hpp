// KineticProjector: the nearest point in the metric of the kinetic energy.
#pragma once

#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/integrators/step/kinetic_metric.hpp"

namespace courant {

// For points (q, p) of T*Q: q moves to the positions of M_f, as little as possible in the metric g of the kinetic
// energy; then p moves into the fibre of M_f over the new q, as little as possible in g⁻¹. No unit is common to q and
// p, so none is needed: a change of units of length, mass or time changes nothing.
//
//   W = {(g⁻¹ ν, 0)} ⊕ {(0, g β)},   ν: conormals (ν, 0) of M_f,   β: momentum parts of all its conormals
//
// The ν are spanned by the differentials of the conditions φ(q, t) = 0 among the equations of the system. With j_i for
// these differentials and C = (C_q, C_p) for the conormals,
//
//   V = (Σ_i g⁻¹ j_i ⟨j_i, C_q⟩_{g⁻¹} / |j_i|²,   g C_p)
//
// has its columns in W, and as many as W has dimensions: where C_p c = 0, C_q c is a combination of the j_i, other than
// zero. Conditions that repeat each other do not matter. Where all conditions are of momenta, this is the projector of
// Section 8.2.
class KineticProjector final : public Projector {
 public:
  // For the M_f of a ladder. Nothing where M is no T*Q or M_f all of it, where the system has no kinetic energy, or
  // where conditions on q alone follow from the equations that none of them says.
  static std::shared_ptr<const KineticProjector> of(
      const std::shared_ptr<const ImplicitSystem>& system, const ConstraintLadder& ladder);

  bool has_constant_directions(Index codimension) const override {
    return count_ == 0 && codimension == bundle_->base()->dimension();
  }
  bool is_always_complement() const override { return true; }
  // (√g, 1/√g), of the diagonal of g at the ladder's point: momenta of any unit are as good as positions.
  VectorXd conormal_sizes() const override { return sizes_; }
  std::shared_ptr<const Projector> balanced(const VectorXd& sizes) const override;

 private:
  // (q, p), t ↦ the j_i, a row each in the tangent representation of Q.
  using Differentials = std::function<ExprMatrix(const ExprVector& x, const Expr& t)>;

  KineticProjector(std::shared_ptr<const CotangentBundle> bundle, KineticMetric metric,
                   Differentials conditions, Index count);

  ExprMatrix do_directions(const ExprVector& x, const Expr& t, const LinearMap<Expr>& tangents,
                           const ExprMatrix& conormals) const override;

  std::shared_ptr<const CotangentBundle> bundle_;
  KineticMetric metric_;
  Differentials conditions_;
  Index count_;  // of conditions
  VectorXd sizes_;
  VectorXd balance_;  // sizes that V is balanced by; empty: 1
};

// The projector that Method 2 takes where none is asked for: that of the kinetic energy, else to the nearest point in
// the numbers themselves. The same in every run of a system.
std::shared_ptr<const Projector> usual_projector(
    const std::shared_ptr<const ImplicitSystem>& system, const ConstraintLadder& ladder);

}  // namespace courant
