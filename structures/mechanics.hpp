// Mechanics: constraints and forces on the configurations of a system.
#pragma once

#include <string>
#include <vector>

#include "courant/structures/dirac_system.hpp"
#include "courant/structures/matrix_field.hpp"

namespace courant {

// What a Lagrangian or a Hamiltonian on T*Q leaves out. Formulas are of a point x = (q, p), the
// velocity w of q in the representation of Q (Ñ) and t. m_h holonomic and m_n nonholonomic
// constraints, multipliers λ and κ:
//
//   q̇ = ∂E/∂p,   ṗ = -∂E/∂q + F(x, w, t) + R(x, w, t) + Σ κ_a ∂g_a/∂w,   E = E₀ + Σ λ_b φ_b(q, t)
//   φ(q, t) = 0,   g(q, w, t) = μ(q, t) w + b(q, t) = 0
//
// (Section 8 of the paper, with the frame's torsion on curved Q; d'Alembert's principle.) With
// `vakonomic` the g are conditions of the variational principle instead: L + Σ κ_a g_a, no reaction.
struct Mechanics {
  using Formula =
      std::function<ExprVector(const ExprVector& x, const ExprVector& w, const Expr& t)>;
  struct Constraints {
    std::vector<std::string> names = {};  // of the equations, as many as there are
    Formula formula = {};                 // empty if there are none
    Index count() const { return static_cast<Index>(names.size()); }
  };

  Constraints holonomic = {};     // φ; w is not used
  Constraints nonholonomic = {};  // g, affine in w
  Formula force = {};             // F, a covector of Q (Ñ); empty: none
  Formula damping = {};           // R, the same; what it takes is dissipated
  bool vakonomic = false;
};

// L(q, w) = ½ g(q)(w, w) - V(q, t), with g: Ñ × Ñ, symmetric.
Lagrangian::Formula mechanical_lagrangian(
    MatrixField metric, std::function<Expr(const ExprVector& q, const Expr& t)> potential);

// E₀ with the conditions of `mechanics`: its holonomic constraints, and with `vakonomic` the
// nonholonomic ones, of a Lagrangian family then (std::invalid_argument otherwise).
std::shared_ptr<const GeneratingFamily> constrained_family(
    std::shared_ptr<const GeneratingFamily> family, const Mechanics& mechanics);

// The rest of `mechanics` on T*Q: forces and the reactions of nonholonomic constraints are vertical.
DiracSystem::Exterior mechanical_exterior(const std::shared_ptr<const CotangentBundle>& phase_space,
                                          const Mechanics& mechanics);

// D of a nonholonomic system with linear constraints that do not depend on time: the canonical
// form restricted to their kernel (Theorem 2.4), so that (v, dH - F) ∈ D. Null for other ones.
std::shared_ptr<const DiracStructure> nonholonomic_structure(
    const std::shared_ptr<const CotangentBundle>& phase_space, const Mechanics& mechanics);

}  // namespace courant
