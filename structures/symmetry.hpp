// Symmetry: a vector field on configurations and its momentum.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "courant/manifolds/law_result.hpp"
#include "courant/structures/dirac_system.hpp"
#include "courant/structures/state.hpp"

namespace courant {

// A vector field ξ on Q, its cotangent lift X on T*Q, and its momentum, the function whose
// Hamiltonian vector field X is:
//
//   J(q, p) = ⟨p, C(q) ξ(q)⟩,   i_X ω_Q = dJ
//
// ξ is given as velocities of the coordinates of Q (N numbers); C(q) is the coframe of Q. X is a
// tangent vector of T*Q (2Ñ), dJ a covector.
//
// Along solutions of a DiracSystem with the canonical structure, sources e and constraints r_a
// (Noether's theorem; with reactions the momentum equation of nonholonomic mechanics, Bloch,
// Krishnaprasad, Marsden, Murray, Arch. Rational Mech. Anal. 136 (1996) 21)
//
//   dJ/dt = -⟨d_xE, X⟩ + ⟪e + Σ_a κ_a r_a, (X, dJ)⟫
//
// in the pairing of TM ⊕ T*M, since (X, dJ) is a section of D, and D is isotropic. Laws of a
// symmetry of a system, measured by check_symmetry:
//
//   Y1  E(q) C(q) ξ(q) = ξ(q)             ξ is tangent to Q
//   Y2  ⟨dφ, X⟩ = 0 where φ = 0           for the entries φ of ∂_λE that contain no λ
//   Y3  ⟨d_xE, X⟩ = 0 where ∂_λE = 0      the energy is invariant, with multipliers of any value
//
// Then J is conserved if nothing from outside acts along ξ. Immutable.
class Symmetry {
 public:
  using Field = std::function<ExprVector(const ExprVector& q)>;  // N
  // Throws std::invalid_argument if something is null.
  Symmetry(std::shared_ptr<const CotangentBundle> phase_space, Field field);

  const std::shared_ptr<const CotangentBundle>& phase_space() const { return phase_space_; }
  ExprVector field(const ExprVector& q) const;         // ξ, N
  Expr momentum(const ExprVector& x) const;            // J
  ExprVector differential(const ExprVector& x) const;  // dJ, 2Ñ
  ExprVector lift(const ExprVector& x) const;          // X, 2Ñ

 private:
  std::shared_ptr<const CotangentBundle> phase_space_;
  Field field_;
};

// A symmetry of a system as it was measured.
struct SymmetryReport {
  std::vector<LawResult> laws;  // Y1, Y2 if there are constraints, Y3
  // What acts along ξ from outside: "the forces", and the constraints, by the names of their
  // equations, whose reactions do.
  std::vector<std::string> acting;

  // Whether ξ is a symmetry, and whether its momentum is conserved: then nothing acts along it from outside.
  bool holds() const { return all_passed(laws); }
  bool is_conserved() const { return holds() && acting.empty(); }
};

// At the point `start` of 𝓛 (whose z may be anything, NaN if not known) and at `count` random ones
// near it. Defects are next to the sum of the terms that cancel. A point where E has no value is
// passed over, but not the start. `name` is that of the symmetry, for the laws. Throws
// std::invalid_argument unless the structure is the canonical one of the phase space.
SymmetryReport check_symmetry(const DiracSystem& system, const Symmetry& symmetry,
                              const State& start, const std::string& name, int count = 8);

}  // namespace courant
