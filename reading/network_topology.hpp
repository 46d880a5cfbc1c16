// What is wrong with how the elements of a network are connected.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "courant/reading/network_element.hpp"
#include "courant/structures/elements/network_assembly.hpp"

namespace courant {

// The nodes by name, the ground first.
struct NetworkNodes {
  std::vector<std::string> names;
  std::vector<std::string> pointers;
  std::map<std::string, Index, std::less<>> index;

  // Of a node that is known; an empty name is the ground.
  Index at(const NetworkTerminal& terminal) const;
};

// The node of every terminal is known, the names of elements are different, no element is shorted,
// every node is of one domain and has a way to the ground; sources of voltage form no loop, sources
// of current no cut-set. Otherwise false, and problems in the words of the network.
bool check_topology(const NetworkNodes& nodes, const std::vector<NetworkElement>& elements,
                    Findings& findings);
// No element needs its own results by way of others. `words` has the currents and voltages, `assembly` the elements at
// the same places.
bool check_circles(const std::vector<NetworkElement>& elements, const NetworkWords& words,
                   const elements::NetworkAssembly& assembly, Findings& findings);

// The domain of each node, that of the first element there; null for the ground.
std::vector<const elements::Domain*> node_domains(const NetworkNodes& nodes,
                                                  const std::vector<NetworkElement>& elements);

}  // namespace courant
