// The branches of a network that elements stand for.
#pragma once

#include <string>
#include <vector>

#include "courant/core/language/symbol_table.hpp"
#include "courant/reading/network_topology.hpp"

namespace courant {

// Branches of all elements, in order, and after them one without current for each potential that laws depend on. Their
// names go into `words`, their states and unknowns into its vocabulary.
class NetworkBranches {
 public:
  // A name that has a meaning already, and a formula that cannot be read, are problems. Arguments are used here alone.
  NetworkBranches(const NetworkNodes& nodes, const std::vector<NetworkElement>& elements,
                  NetworkWords& words, Findings& findings);

  std::vector<NetworkBranch> branches;
  NameList outputs;                        // of ports
  std::vector<std::vector<Index>> states;  // of each element
  std::size_t of_elements = 0;             // branches before those that measure potentials
  bool right = true;                       // whether there were no problems

 private:
  class Assembly;
};

}  // namespace courant
