// Parameters of a netlist: those of the whole and of each instance of a subcircuit, under names of their own.
#pragma once

#include <string>

#include "courant/extensions/spice/netlist_circuit.hpp"

namespace courant::netlist {

// Adds parameters to a circuit, and to the scopes in which formulas find them: a name that several instances have,
// or that formulas have already, is another one in the circuit.
class NetlistParameters {
 public:
  // Both are to live as long as this.
  NetlistParameters(NetlistCircuit& circuit, LineProblems& problems)
      : circuit_(circuit), problems_(problems) {}

  // `formula` is one of the circuit's parameters. `prefix`: of the instance, "x1.". Throws LineError unless it
  // has a value.
  void define(Scope& scope, const std::string& prefix, const std::string& name,
              const std::string& formula, int line);
  // Those first that the others need. The last value of a name counts; in it, the name itself is the one
  // outside. What cannot be defined is a problem.
  void define(Scope& scope, const std::string& prefix, const Assignments& list);

 private:
  NetlistCircuit& circuit_;
  LineProblems& problems_;
};

}  // namespace courant::netlist
