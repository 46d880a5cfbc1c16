// SPICE netlists as experiments.
#pragma once

#include <string_view>

#include "courant/reading/findings.hpp"

namespace courant {

// The experiment with a `network` that a netlist describes: R, L, C, V, I, K, D, E, F, G, H and X,
// .param, .subckt, .model (of diodes), .tran, .ic, .print; sources with DC, PULSE, SIN, PWL, EXP.
// Nodes and parameters are in lower case. Without `uic` it starts where the voltages of inductors
// and the currents of capacitors are zero, as SPICE does.
//
// Throws ExperimentError with every line that is wrong or not supported, as `line 7`.
Json import_netlist(std::string_view text);

}  // namespace courant
