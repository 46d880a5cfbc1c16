// The Dirac system of a Lagrangian.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "courant/structures/mechanics.hpp"

namespace courant {

// S = ♯_ω(𝓘⁻¹(Im dL)) ⊂ TT*Q (Section 5.1.1 of the paper), with constraints and forces, and with
// the words for its findings: the auxiliary unknowns are the velocities x' (v_R[0], … where those
// are not represented by x'), then the multipliers lambda, holonomic ones first; the equations say
// which variable's they are. `coordinates` names the N + Ñ numbers of a point (q, p).
//
// `structure`, on that T*Q, is the D of the generalised systems (D, 𝓛) of Section 2.3; null for the
// canonical one. Its port variables are the last unknowns.
std::shared_ptr<const DiracSystem> lagrangian_system(
    std::shared_ptr<const CotangentBundle> phase_space, Lagrangian::Formula lagrangian,
    const std::vector<std::string>& coordinates, const Mechanics& mechanics = {},
    std::shared_ptr<const DiracStructure> structure = nullptr);

// The same for a Hamiltonian or any other family on a manifold that may be no cotangent bundle: then
// `mechanics` has holonomic constraints alone, functions of the point. `parameters` names those of
// the family.
std::shared_ptr<const DiracSystem> hamiltonian_system(
    std::shared_ptr<const DiracStructure> structure, std::shared_ptr<const GeneratingFamily> family,
    const std::vector<std::string>& coordinates, const Mechanics& mechanics = {},
    const std::vector<std::string>& parameters = {});

}  // namespace courant
