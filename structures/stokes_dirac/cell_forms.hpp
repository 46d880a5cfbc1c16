// The coordinates of a system that are the integrals of forms over cells.
#pragma once

#include <vector>

#include "courant/structures/implicit_system.hpp"
#include "courant/structures/stokes_dirac/cell_form.hpp"

namespace courant {

// Those of a StokesDiracSystem, and of each that an interconnection is made of; none of other systems.
std::vector<CellForm> cell_forms(const ImplicitSystem& system);

}  // namespace courant
