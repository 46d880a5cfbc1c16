// The Dirac system of a Lagrangian.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "courant/structures/dirac_system.hpp"

namespace courant {

// S = ♯_ω(𝓘⁻¹(Im dL)) ⊂ TT*Q (Section 5.1.1 of the paper), with the words for its findings: the
// auxiliary unknowns are the velocities x', and the equations say which variable's they are.
// `coordinates` names the N + Ñ numbers of a point (q, p).
std::shared_ptr<const DiracSystem> lagrangian_system(
    std::shared_ptr<const CotangentBundle> phase_space, Lagrangian::Formula lagrangian,
    const std::vector<std::string>& coordinates);

}  // namespace courant
