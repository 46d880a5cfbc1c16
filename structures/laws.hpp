// The laws of DiracStructure and of GeneratingFamily, measured.
#pragma once

#include <span>
#include <vector>

#include "courant/manifolds/laws.hpp"
#include "courant/structures/dirac_structure.hpp"
#include "courant/structures/family_rank.hpp"
#include "courant/structures/generating_family.hpp"

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

// Every law of `family` (G1, G2 in the comment of GeneratingFamily) at the points. Derivatives are
// held against differences of order 6 of the value alone.
std::vector<LawResult> check_generating_family(const GeneratingFamily& family,
                                               std::span<const FamilyPoint> points);

}  // namespace courant
