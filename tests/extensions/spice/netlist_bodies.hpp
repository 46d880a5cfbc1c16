// Circuits of netlists in tests, without their titles and ends.
#pragma once

#include <string>

#include "courant/extensions/spice/netlist_circuit_reader.hpp"

namespace courant {

inline netlist::NetlistCircuit circuit_of(const std::string& body,
                                          const std::string& transient = ".tran 1u 1m") {
  LineProblems problems{"the netlist"};
  const netlist::Deck deck =
      netlist::read_deck("A title\n" + body + "\n" + transient + "\n", problems);
  netlist::NetlistCircuit circuit = netlist::read_circuit(deck, problems);
  problems.require_none();
  return circuit;
}

// What is said of one that is wrong.
inline std::string refusal(const std::string& body) {
  try {
    circuit_of(body);
  } catch (const ExperimentError& error) {
    return error.what();
  }
  return "";
}

}  // namespace courant
