// DiracSystem: a Dirac structure and a generating family.
#pragma once

#include "courant/structures/dirac_structure.hpp"
#include "courant/structures/generating_family.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

// S = {v ∈ TM : (v, α) ∈ D, α ∈ 𝓛} (Section 2.3 of the paper; the general form (D, 𝓛)), as
// equations in x, v and the auxiliary unknowns z = (λ, u), with E the generating family:
//
//   membership(x, v, frame(x)ᵀ ∂_xE(x, λ), u) = 0
//   ∂_λE(x, λ) = 0
class DiracSystem final : public ImplicitSystem {
 public:
  // Both on the same manifold; throws std::invalid_argument otherwise. `names` as in
  // ImplicitSystem.
  DiracSystem(std::shared_ptr<const DiracStructure> structure,
              std::shared_ptr<const GeneratingFamily> family, Names names = {});

  std::shared_ptr<const DiracStructure> structure() const override { return structure_; }
  const std::shared_ptr<const GeneratingFamily>& family() const { return family_; }
  Index tangent_blocks() const override { return structure_->tangent_blocks(); }
  // S = ♯_ω(𝓛): where the structure is canonical, S is as Lagrangian as 𝓛 is.
  std::optional<bool> is_lagrangian() const override {
    return structure_->is_canonical() ? family_->is_morse() : std::nullopt;
  }

 private:
  ExprVector do_residual(const ExprVector& x, const ExprVector& v, const ExprVector& z,
                         const Expr& t) const override;
  std::optional<Expr> do_energy(const ExprVector& x, const ExprVector& z,
                                const Expr& t) const override;
  VectorXd do_auxiliary_guess(const VectorXd& x, const VectorXd& v) const override;

  std::shared_ptr<const DiracStructure> structure_;
  std::shared_ptr<const GeneratingFamily> family_;
};

}  // namespace courant
