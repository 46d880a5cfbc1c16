// What a Dirac structure is, in words and numbers.
#pragma once

#include <string>
#include <vector>

#include "courant/manifolds/law_result.hpp"
#include "courant/reading/findings.hpp"
#include "courant/structures/dirac_structure.hpp"

namespace courant {

// What `courant check --json` says of a structure at the first point, and of its ranks and its integrability at all
// of them: dimension, rank_of_F, isotropic, coisotropic, dirac, integrable, … (see check_experiment). `ports`: its
// name among several structures of a system; `coordinates`: those of its manifold.
Json structure_description(const std::string& ports, const DiracStructure& structure,
                           const std::vector<VectorXd>& points,
                           const std::vector<std::string>& coordinates);

// Whether a port-Hamiltonian structure is what Proposition 7.1 says of it at the points; nothing of other structures.
std::vector<LawResult> proposition_7_1(const DiracStructure& structure,
                                       const std::vector<VectorXd>& points);

}  // namespace courant
