// Random circuits of resistors, inductors, capacitors and sources, in random units, with their
// topological counts.
#pragma once

#include <cmath>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "courant/structures/network.hpp"

namespace courant::test {

// Parts of the nodes 0 … n-1 that branches join.
class Parts {
 public:
  explicit Parts(Index nodes) : parent_(static_cast<std::size_t>(nodes)) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
  }
  Index of(Index node) const {
    while (parent_[static_cast<std::size_t>(node)] != node)
      node = parent_[static_cast<std::size_t>(node)];
    return node;
  }
  // Whether these were two parts before.
  bool join(Index a, Index b) {
    a = of(a);
    b = of(b);
    parent_[static_cast<std::size_t>(a)] = b;
    return a != b;
  }

 private:
  std::vector<Index> parent_;
};

struct RandomCircuit {
  std::shared_ptr<const Network> network;
  std::string description;
  Index states = 0;
  Index capacitor_loops = 0;    // independent loops of capacitors and voltage sources
  Index inductor_cut_sets = 0;  // independent cut-sets of inductors and current sources

  Index degrees_of_freedom() const { return states - capacitor_loops - inductor_cut_sets; }
};

// A connected graph with up to `most_nodes` nodes. No voltage sources close a loop, no current
// sources a cut-set. Time, voltage and current have units between 1e-9 and 1e9.
inline RandomCircuit random_circuit(std::mt19937& generator, Index most_nodes) {
  enum Type { R, C, L, V, I };
  struct Element {
    Type type;
    Index from, to;
    double value;
  };
  const auto uniform = [&](double a, double b) {
    return a + (b - a) * static_cast<double>(generator()) / static_cast<double>(generator.max());
  };
  const auto node_below = [&](Index n) {
    return static_cast<Index>(generator() % static_cast<unsigned long>(n));
  };
  const double time = std::pow(10.0, uniform(-9.0, 9.0));
  const double volt = std::pow(10.0, uniform(-9.0, 9.0));
  const double ampere = std::pow(10.0, uniform(-9.0, 9.0));
  const Index nodes = 2 + node_below(most_nodes - 1);
  const Index extra = 1 + node_below(nodes);
  Parts of_voltages(nodes);
  std::vector<Element> elements;
  bool stores = false;
  for (Index k = 1; k < nodes + extra || !stores; ++k) {
    Element element{static_cast<Type>(generator() % 3), k < nodes ? k : node_below(nodes), 0, 0.0};
    element.to = k < nodes ? node_below(k) : node_below(nodes);
    if (element.from == element.to) continue;
    const double size = std::pow(10.0, uniform(-1.0, 1.0));
    // A source of current beside a branch of the tree of other things is in no cut-set of sources.
    const unsigned long dice = generator() % 10;
    if (dice == 0 && of_voltages.join(element.from, element.to)) element.type = V;
    if (dice == 1 && k >= nodes) element.type = I;
    const double unit = element.type == R   ? volt / ampere
                        : element.type == C ? ampere * time / volt
                        : element.type == L ? volt * time / ampere
                        : element.type == V ? volt
                                            : ampere;
    element.value = size * unit;
    stores = stores || element.type == C || element.type == L;
    elements.push_back(element);
  }

  RandomCircuit circuit;
  std::vector<NetworkBranch> branches;
  std::vector<std::pair<Index, double>> energies;
  Parts of_charges(nodes), of_others(nodes);
  Index loops = 0, joined = 0;
  for (const Element& element : elements) {
    const char* letters = "RCLVI";
    NetworkBranch branch{.name = letters[element.type] + std::to_string(branches.size()),
                         .from = element.from,
                         .to = element.to};
    circuit.description +=
        " " + branch.name + " " + std::to_string(element.from) + "-" + std::to_string(element.to);
    const auto index = static_cast<Index>(branches.size());
    const double value = element.value;
    switch (element.type) {
      case R:
        branch.law = [value, index](const NetworkVariables& variables) {
          return value * variables.current(index);
        };
        break;
      case C:
      case L:
        branch.kind = element.type == C ? NetworkBranch::Kind::charge : NetworkBranch::Kind::flux;
        branch.role = NetworkBranch::Role::storage;
        energies.emplace_back(circuit.states++, value);
        break;
      case V:
      case I:
        branch.kind =
            element.type == V ? NetworkBranch::Kind::current : NetworkBranch::Kind::voltage;
        branch.role = NetworkBranch::Role::source;
        branch.law = [value, time](const NetworkVariables& variables) {
          return value * sin(variables.t() / time + 0.5);
        };
    }
    if (element.type == C || element.type == V) loops += !of_charges.join(element.from, element.to);
    if (element.type != L && element.type != I) joined += of_others.join(element.from, element.to);
    branches.push_back(std::move(branch));
  }
  circuit.capacitor_loops = loops;
  circuit.inductor_cut_sets = nodes - 1 - joined;
  circuit.network = std::make_shared<Network>(nodes, std::move(branches),
                                              [energies](const ExprVector& x, const Expr&) {
                                                Expr sum = 0.0;
                                                for (const auto& [state, value] : energies)
                                                  sum += square(x[state]) / (2.0 * value);
                                                return sum;
                                              });
  return circuit;
}

}  // namespace courant::test
