// DiracSystem: a Dirac structure and a generating family.
#pragma once

#include <functional>

#include "courant/structures/dirac_structure.hpp"
#include "courant/structures/energy_system.hpp"
#include "courant/structures/generating_family.hpp"

namespace courant {

// S = {v ∈ TM : (v, α) ∈ D, α ∈ 𝓛} (Section 2.3 of the paper; the general form (D, 𝓛)), as
// equations in x, v and the auxiliary unknowns z = (λ, u), with E the generating family:
//
//   membership(x, v, frame(x)ᵀ ∂_xE(x, λ), u) = 0
//   ∂_λE(x, λ) = 0
//
// What acts on it from outside shifts the pair. With sources e(x, v, α, t) ∈ TM ⊕ T*M (forces,
// inputs) and constraints g(x, v, α, t) = 0, z = (λ, κ, u) and
//
//   (v, α) - e - Σ_a κ_a (∂g_a/∂α, ∂g_a/∂v) ∈ D,   g = 0
//
// where (∂g/∂α, ∂g/∂v) is the gradient of g in the pairing of TM ⊕ T*M. For g = ⟨μ(x), v⟩ it is the
// covector (0, μ): with D the graph of a two-form that is its restriction to the kernel of μ
// (Theorem 2.4), nonholonomic mechanics. For g = ⟨α, X(x)⟩ it is the vector (X, 0): with D the graph
// of a bivector a closed port (Theorem 2.5, equation (23)).
//
// Power is supplied by "forces", the sources, by "constraints" that move and, where D is no Dirac structure, by its
// "ports"; it is dissipated by "damping", the sources that damp. A Dirac structure is isotropic, so ⟨α, v⟩ is what is
// left of the pairing with sources and reactions.
class DiracSystem final : public EnergySystem {
 public:
  // A function of a point x (N), v and α (Ñ each) and t.
  using Law = std::function<ExprVector(const ExprVector& x, const ExprVector& v,
                                       const ExprVector& alpha, const Expr& t)>;
  struct Exterior {
    Law source = {};      // of e, one vector of 2Ñ, a tangent vector and a covector; empty: none
    Law damping = {};     // what else e has, such as friction: what it takes is dissipated
    Law constraint = {};  // g, size `constraint_count`
    Index constraint_count = 0;

    bool has_sources() const { return source || damping; }
  };

  // Both on the same manifold; throws std::invalid_argument otherwise. `names` as in
  // ImplicitSystem.
  DiracSystem(std::shared_ptr<const DiracStructure> structure,
              std::shared_ptr<const GeneratingFamily> family, Names names = {});
  // The equations of g come last.
  DiracSystem(std::shared_ptr<const DiracStructure> structure,
              std::shared_ptr<const GeneratingFamily> family, Exterior exterior, Names names = {});

  std::shared_ptr<const DiracStructure> structure() const override { return structure_; }
  const std::shared_ptr<const GeneratingFamily>& family() const { return family_; }
  const Exterior& exterior() const { return exterior_; }
  // e, 2Ñ: 0 where there are no sources.
  ExprVector sources(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                     const Expr& t) const;
  Index tangent_blocks() const override { return structure_->tangent_blocks(); }
  // S = ♯_ω(𝓛): where the structure is canonical, S is as Lagrangian as 𝓛 is.
  std::optional<bool> is_lagrangian() const override {
    const bool closed = !exterior_.has_sources() && !exterior_.constraint;
    return closed && structure_->is_canonical() ? family_->is_morse() : std::nullopt;
  }

 private:
  Expr do_generator(const ExprVector& x, const ExprVector& z, const Expr& t) const override;
  ExprVector do_effort(const ExprVector& x, const ExprVector& z, const Expr& t) const override;
  ExprVector do_equations(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                          const ExprVector& z, const Expr& t, const ExprVector& y,
                          const Expr& s) const override;
  Powers do_powers(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                   const ExprVector& z, const Expr& t) const override;
  bool do_has_explicit_energy() const override;
  std::optional<Expr> do_energy(const ExprVector& x, const ExprVector& z,
                                const Expr& t) const override;
  VectorXd do_auxiliary_guess(const VectorXd& x, const VectorXd& v) const override;
  ExprVector constraint(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                        const Expr& t) const;
  ExprVector reaction(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                      const ExprVector& kappa, const Expr& t) const;

  std::shared_ptr<const DiracStructure> structure_;
  std::shared_ptr<const GeneratingFamily> family_;
  Exterior exterior_;
};

}  // namespace courant
