// MorseFamily: a generating family by a formula.
#pragma once

#include "courant/structures/generating_family.hpp"

namespace courant {

// Any E(x, λ, t) with λ ∈ R^k. That it satisfies the rank condition is claimed if nothing else is
// said: law G2.
class MorseFamily final : public GeneratingFamily {
 public:
  using Formula = std::function<Expr(const ExprVector& x, const ExprVector& lambda, const Expr& t)>;
  // What `energy` returns; E itself if `energy` is empty.
  MorseFamily(std::shared_ptr<const Manifold> manifold, Index k, Formula formula,
              Formula energy = {}, std::optional<bool> is_morse = true);
  std::optional<bool> is_morse() const override { return is_morse_; }

 private:
  Expr do_value(const ExprVector& x, const ExprVector& lambda, const Expr& t) const override {
    return formula_(x, lambda, t);
  }
  Expr do_energy(const ExprVector& x, const ExprVector& lambda, const Expr& t) const override {
    return energy_ ? energy_(x, lambda, t) : formula_(x, lambda, t);
  }
  Formula formula_, energy_;
  std::optional<bool> is_morse_;
};

// Pontryagin's E(q, p, u) = ⟨p, f(q, u, t)⟩ - c ℓ(q, u, t) on T*Q, for the optimal control problem
// q̇ = f(q, u, t), ∫ ℓ(q, u, t) dt → min. f is a tangent vector of Q (Ñ); u has size k. The constant
// c is 1 for normal extremals, 0 for abnormal ones, which know nothing of the cost.
//
// E is a Morse family where ∂f/∂u has rank k, or ∂²E/∂u² has. That is claimed where entries that are
// the same everywhere show it; f = q u with a cost that is linear in u is none at q = 0.
//
// ∂E/∂u = 0 determines u where ∂²E/∂u² is regular: then the system is regular with index 0. Where it
// is not, on singular and on abnormal arcs, the constraint algorithm differentiates it.
struct ControlProblem {
  MorseFamily::Formula cost;  // ℓ, of (q, u, t)
  std::function<ExprVector(const ExprVector& q, const ExprVector& u, const Expr& t)> dynamics;
  Index controls = 0;  // k
  double cost_multiplier = 1.0;
};
std::shared_ptr<const MorseFamily> pontryagin_family(
    const std::shared_ptr<const CotangentBundle>& phase_space, const ControlProblem& problem);

}  // namespace courant
