// Transistors.
#pragma once

#include "courant/structures/elements/bipolar_transistor.hpp"
#include "courant/structures/elements/electrical.hpp"
#include "courant/structures/elements/mos_channel.hpp"

namespace courant::elements {

// Terminals: collector, base, emitter. Branches <name>_be and <name>_bc, and charges q_be_<name> and q_bc_<name> where
// a junction has any. `joined`: nodes of the terminals, of which two may be the same, which have no branch between
// them.
Element bipolar_transistor(const BipolarTransistor& law, const JunctionCharge& at_emitter,
                           const JunctionCharge& at_collector, bool is_pnp,
                           const std::vector<Index>& joined = {0, 1, 2});

// Terminals: drain, gate, source, bulk. Branches <name>_ds, <name>_gs, <name>_bs.
Element mos_transistor(const MosChannel& channel, bool is_p,
                       const std::vector<Index>& joined = {0, 1, 2, 3});

}  // namespace courant::elements
