// `courant import` as it is fuzzed.
#pragma once

#include <string>

namespace courant::fuzz {

// Imports the text as a netlist or a robot. What is imported is an experiment that reads: `constraints` is given it,
// and finds no mistake in how it is written; `run` answers it.
void require_import(const std::string& text);

}  // namespace courant::fuzz
