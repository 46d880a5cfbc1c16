// Inductors that mutual inductances couple.
#pragma once

#include <vector>

#include "courant/reading/network_element.hpp"
#include "courant/structures/elements/network_assembly.hpp"

namespace courant {

// Couples the inductors of all mutual inductances among the elements, which are in the assembly. False, and a problem,
// where one names no inductor of the elements or the same one twice, or where the inductance matrix 𝓛 is not positive
// definite.
bool couple(const std::vector<NetworkElement>& elements, elements::NetworkAssembly& assembly,
            Findings& findings);

}  // namespace courant
