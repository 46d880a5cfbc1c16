// The branches of a network that elements stand for.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "courant/core/language/symbol_table.hpp"
#include "courant/reading/network_topology.hpp"

namespace courant {

// The elements, in order, and after them a branch without current for each potential that laws depend on. Their
// names go into `words`, their states and unknowns into its vocabulary.
class NetworkBranches {
 public:
  // A name that has a meaning already, and a formula that cannot be read, are problems. Arguments are used here alone.
  NetworkBranches(const NetworkNodes& nodes, const std::vector<NetworkElement>& elements,
                  NetworkWords& words, Findings& findings);

  elements::NetworkAssembly assembly;
  NameList outputs;  // of ports
  // Of currents, voltages and potentials, and the names of ∂H/∂x, as a Model has them.
  std::map<std::string, std::string, std::less<>> kinds;
  std::vector<std::string> efforts;
  std::size_t of_elements = 0;  // branches before those that measure potentials
  bool right = true;            // whether there were no problems

 private:
  class Naming;
};

}  // namespace courant
