// ConstrainedFamily: a generating family with conditions.
#pragma once

#include "courant/structures/generating_family.hpp"

namespace courant {

// E(x, (λ, κ), t) = E₀(x, λ, t) + Σ_a κ_a c_a(x, λ, t), a Morse family with the m conditions
// ∂E/∂κ = c = 0 and multipliers κ:
//
//   holonomic constraints   E₀ a Hamiltonian or a Lagrangian, c = φ(x)
//   vakonomic mechanics     E₀ = ⟨p, w⟩ - L(q, w), c = -g(q, w): the Lagrangian L + Σ κ_a g_a, with
//                           p = ∂L/∂w + Σ κ_a ∂g_a/∂w
//
// The energy is that of E₀ and, as for any family, 𝓛 is a submanifold of T*M where the c are
// independent: the rank condition of GeneratingFamily.
class ConstrainedFamily final : public GeneratingFamily {
 public:
  using Condition = std::function<ExprVector(const ExprVector& x, const ExprVector& lambda,
                                             const Expr& t)>;  // size m
  // Throws std::invalid_argument if `family` is null or `condition` is empty.
  ConstrainedFamily(std::shared_ptr<const GeneratingFamily> family, Condition condition, Index m);

  const std::shared_ptr<const GeneratingFamily>& unconstrained() const { return family_; }
  Index condition_count() const { return count_; }

 private:
  Expr do_value(const ExprVector& x, const ExprVector& lambda, const Expr& t) const override;
  Expr do_energy(const ExprVector& x, const ExprVector& lambda, const Expr& t) const override;
  VectorXd do_parameter_guess(const VectorXd& x, const VectorXd& v) const override;

  std::shared_ptr<const GeneratingFamily> family_;
  Condition condition_;
  Index count_;
};

}  // namespace courant
