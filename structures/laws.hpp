// The laws of DiracStructure, measured.
#pragma once

#include <span>
#include <vector>

#include "courant/manifolds/laws.hpp"
#include "courant/structures/dirac_structure.hpp"

namespace courant {

// Every law of `structure` (S1 to S7 in the comment of DiracStructure) at the points, or at random
// ones of its manifold. Independent of how the structure is described: the pairing is taken on
// elements that solve the equations, and the residuals on and off D_x are those of the membership
// itself.
//
// Does not throw for a wrong structure: what a function throws counts as an infinite defect of the
// law, and `where` says what it was.
std::vector<LawResult> check_structure(const DiracStructure& structure,
                                       std::span<const VectorXd> points,
                                       const LawOptions& options = {});
std::vector<LawResult> check_structure(const DiracStructure& structure,
                                       const LawOptions& options = {});

}  // namespace courant
