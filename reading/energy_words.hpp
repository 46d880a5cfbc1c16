// The words that an experiment has for the energies of its steps.
#pragma once

#include "courant/reading/model.hpp"

namespace courant {

// Energies since the beginning of a run, of a system with ports:
//
//   supplied, dissipated                           of all ports
//   supplied_<port> …, dissipated_<element> …      of each, as StepEnergies has them
//
// Those whose name has a meaning already have none here. Empty for a system without ports, or without
// powers.
NameList energy_words(const Model& model);

// Whether these are the words of a system that has ports other than the reactions of constraints,
// which do no work where the constraints are linear in velocities.
bool has_ports(const NameList& energy_words);

}  // namespace courant
