// The balance of energy that steps keep.
#pragma once

#include "courant/integrators/methods/integrator_setting.hpp"

namespace courant {

// |ΔH - supplied + dissipated|, the greatest of 20 steps of h from the initial state (of 5 if they go back
// in time: a system with losses does not go far there), next to the greatest energies that take part in a
// step: H at both ends and what moves. Throws std::domain_error for a system whose H is no function on M, and what a
// step throws.
double energy_imbalance(const Integrator& integrator, const IntegratorSetting& setting, double h);

}  // namespace courant
