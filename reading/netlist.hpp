// SPICE netlists as experiments.
#pragma once

#include <string_view>
#include <vector>

#include "courant/reading/findings.hpp"

namespace courant {

// The experiment with a `network` that a netlist describes: R, L, C, V, I, K, D, E, F, G, H and X,
// .param, .subckt, .model (of diodes), .tran, .ic, .print; sources with DC, PULSE, SIN, PWL, EXP.
// Nodes and parameters are in lower case. As in SPICE, it starts without `uic` at the operating point,
// with the nodes of .ic held; with `uic` from ic= and, where an element has none, from .ic, with all
// other nodes at 0 V.
//
// Throws ExperimentError with every line that is wrong or not supported, as `line 7`. `notes` are of
// lines that have no effect.
Json import_netlist(std::string_view text, std::vector<Problem>* notes = nullptr);

}  // namespace courant
