// NetworkAssembly: a network from elements.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "courant/structures/elements/element.hpp"
#include "courant/structures/elements/mutual_inductance.hpp"

namespace courant::elements {

// Elements one after the other, between nodes that are numbers; 0 is the ground.
//
//   NetworkAssembly circuit;
//   circuit.add("V", voltage_source(5.0), {1, 0});
//   circuit.add("R", resistor(100.0), {1, 2});
//   circuit.add("C", capacitor(1e-6), {2, 0});
//   const std::shared_ptr<const Network> system = circuit.network();   // coordinates q_C; unknowns i_V, i_R
//
// Branches and states have the order of the elements. Copyable.
class NetworkAssembly {
 public:
  // Where an element is.
  struct Place {
    std::string name;
    Element element;
    Index first_branch = 0;
    std::vector<Index> states = {};  // coordinates
  };

  // `nodes`: of the terminals. Throws std::invalid_argument where their number is another one, a node is negative, an
  // element has this name, or the two ends of a branch are one node.
  void add(const std::string& name, Element element, const std::vector<Index>& nodes);
  // A branch that no element has.
  void add_branch(NetworkBranch branch) { branches_.push_back(std::move(branch)); }
  // Couples two inductors that are given by their inductances, by M/√(L₁ L₂). False, and nothing is done, where all
  // couplings of both together are not between -1 and 1. Throws std::invalid_argument where a name is none of such an
  // inductor, or both are one.
  bool couple(const std::string& first, const std::string& second, double coupling);
  // Whether the energy of the inductors that are coupled is positive: each pair may be coupled so, and all together
  // not.
  bool has_positive_inductances() const { return coupled_.is_definite(); }

  const std::vector<Place>& places() const { return places_; }
  const std::vector<NetworkBranch>& branches() const { return branches_; }
  Index state_count() const { return states_; }
  // H of all states.
  Network::Energy energy() const;
  // Throws std::invalid_argument where Network does, and where inductors are coupled so that their energy is not
  // positive.
  std::shared_ptr<const Network> network() const;

 private:
  Index member(const std::string& inductor);

  std::vector<Place> places_;
  std::map<std::string, std::size_t, std::less<>> numbers_;  // of places, by name
  std::vector<NetworkBranch> branches_;
  Index states_ = 0, nodes_ = 1;
  std::vector<std::size_t> members_;  // places of inductors that are coupled
  MutualInductance coupled_;
};

}  // namespace courant::elements
