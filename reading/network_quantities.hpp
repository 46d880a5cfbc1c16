// Currents, voltages and potentials as words of formulas.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "courant/reading/network_topology.hpp"

namespace courant {

// The names of the potentials of all nodes but the ground, of the domains that these have.
std::vector<std::string> potential_names(const NetworkNodes& nodes,
                                         const std::vector<const elements::Domain*>& kinds);

// Definitions may depend on what laws give, which may depend on definitions of states and t: they
// are checked with the names alone.
void check_network_definitions(Vocabulary& vocabulary, const NetworkWords& words,
                               const std::vector<std::string>& potentials, Findings& findings);

// Whether laws and energies are right; laws know currents, voltages and potentials besides.
bool check_formulas(const std::vector<NetworkElement>& elements, const NetworkWords& words,
                    const std::vector<std::string>& potentials, Findings& findings);

// The values of all that is no unknown already: of the first `of_elements` branches, and of the nodes.
Vocabulary::Derived network_quantities(const std::shared_ptr<const Network>& network,
                                       const Vocabulary& vocabulary, std::size_t of_elements,
                                       const NetworkNodes& nodes,
                                       const std::vector<const elements::Domain*>& kinds);

}  // namespace courant
