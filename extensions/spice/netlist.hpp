// SPICE netlists as experiments.
#pragma once

#include <string_view>
#include <vector>

#include "courant/extensions/spice/netlist_text.hpp"
#include "courant/reading/findings.hpp"

namespace courant {

// The experiment with a `network` that a netlist describes: R, L, C, V, I, K, D, E, F, G, H, B, S, W, Q, M (level 1) and
// X, .param, .func, .global, .subckt, .model, .include, .tran, .ic; sources with DC, PULSE, SIN, PWL, EXP.
// Nodes and parameters are in lower case. As in SPICE, it starts without `uic` at the operating point,
// with the nodes of .ic held; with `uic` from ic= and, where an element has none, from .ic, with all
// other nodes at 0 V.
//
// Throws ExperimentError with every line that is wrong or not supported, as `line 7`. `notes` are of
// lines that have no effect. `included` gives the text of a file that the netlist includes.
Json import_netlist(std::string_view text, std::vector<Problem>* notes = nullptr,
                    const IncludedText& included = {});

}  // namespace courant
