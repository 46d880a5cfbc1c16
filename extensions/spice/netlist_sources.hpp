// The waveforms of SPICE sources as formulas of t.
#pragma once

#include <string>
#include <vector>

#include "courant/core/language/symbol_table.hpp"
#include "courant/extensions/spice/netlist_text.hpp"
#include "courant/integrators/methods/substepping_integrator.hpp"

namespace courant::netlist {

// Of the .tran line, for values that are left out.
struct Times {
  double step = 0.0, end = 0.0;
};

// The formula of the words of a source after its nodes: [DC] value, PULSE, SIN, PWL, EXP, SFFM or AM; AC is
// left out. The values of a waveform stand in their order or, as Gnucap has them, behind names: `sin ampl=2 freq=1k`. Values may be expressions of parameters; times of PULSE and PWL become numbers, by the
// values of parameters. The times after the start, and before the end, at which it bends are added to
// `corners` if that is given. Throws LineError.
std::string source(const std::vector<std::string>& words, const Scope& scope, const Times& times,
                   int line, const SymbolTable& parameters = {},
                   std::vector<Corner>* corners = nullptr);

}  // namespace courant::netlist
