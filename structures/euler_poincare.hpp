// Euler–Poincaré and Lie–Poisson systems with inputs, constraints and advected parameters.
#pragma once

#include <string>
#include <vector>

#include "courant/structures/dirac_system.hpp"
#include "courant/structures/lie_algebra.hpp"
#include "courant/structures/lie_poisson.hpp"

namespace courant {

// A system on a Lie group G whose Lagrangian is invariant but for parameters a ∈ V* on which G acts,
// reduced to (g ⋉ V)* = {(μ, a)}: with the Lie–Poisson structure D of g ⋉ V and
//
//   E(μ, a, ξ) = ⟨μ, ξ⟩ - ℓ(ξ, a, t)   or   E = h(μ, a, t),   ξ = ∂E/∂μ ∈ g
//
//   μ̇ = ad*_ξ μ - ρ*_{∂E/∂a} a + u(μ, a, ξ, t) + Σ κ_c ∂g_c/∂ξ,   ȧ = ρ(ξ)ᵀ a,   g(a, ξ, t) = 0
//
// for left-invariant systems (Sign::minus): on so(3)* the Euler equations, with a = Γ, the vertical
// in the body, and ρ(ξ) = ξ × those of the heavy top. Inputs u and the reactions of constraints g
// that are linear in ξ (Suslov's problem: Euler–Poincaré–Suslov) act on μ alone.
struct EulerPoincare {
  using Function = std::function<Expr(const ExprVector& y, const ExprVector& a, const Expr& t)>;
  using Input = std::function<ExprVector(const ExprVector& mu, const ExprVector& a,
                                         const ExprVector& xi, const Expr& t)>;  // n
  using Constraint =
      std::function<ExprVector(const ExprVector& a, const ExprVector& xi, const Expr& t)>;

  LieAlgebra algebra;                          // g, dimension n
  std::vector<MatrixXd> representation = {};   // ρ(e_i), d × d each; none: no parameters
  Function lagrangian = {}, hamiltonian = {};  // one of the two: ℓ with y = ξ, h with y = μ
  Input input = {};                            // empty: none
  Constraint constraint = {};                  // g, as many as there are names; empty: none
  std::vector<std::string> constraint_names = {};
  LiePoisson::Sign sign = LiePoisson::Sign::minus;
  // With a group the attitude x ∈ G, ẋ = x ξ, is part of the state (μ, a, x).
  std::shared_ptr<const Manifold> group = nullptr;
};

// On Euclidean(n + d), or on its product with the group. Auxiliary unknowns: ξ with a Lagrangian, then multipliers.
// `names` has those of the coordinates (μ, a) and of ξ; it may be empty. Throws std::invalid_argument unless there is
// either a Lagrangian or a Hamiltonian, and as LiePoisson does.
struct EulerPoincareNames {
  std::vector<std::string> coordinates = {}, velocities = {};
};
std::shared_ptr<const DiracSystem> euler_poincare_system(const EulerPoincare& problem,
                                                         const EulerPoincareNames& names = {});

}  // namespace courant
