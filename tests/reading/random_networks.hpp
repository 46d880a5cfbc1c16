// Random networks of resistors, inductors, capacitors and sources, with their topological counts.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "../core/campaign.hpp"
#include "courant/reading/findings.hpp"

namespace courant::test {

struct RandomNetwork {
  Json system;       // of type "network"
  std::string text;  // its elements, each with its nodes
  VectorXd at_rest;  // all charges and fluxes zero
  // Charges and fluxes that Kirchhoff's laws allow at t = 0, made of random potentials and loop currents.
  VectorXd consistent;
  Index states = 0;
  Index capacitor_loops = 0;    // independent loops of capacitors and voltage sources
  Index inductor_cut_sets = 0;  // independent cut-sets of inductors and current sources

  Index dependent() const { return capacitor_loops + inductor_cut_sets; }
};

// How the values of a network are spread.
enum class Spread {
  // A factor of 100 among elements of a type, but units of time, voltage and current between 1e-9 and 1e9.
  units,
  // SI units, each element by itself: 1 Ω … 1 MΩ, 1 pF … 1 mF, 1 nH … 1 H.
  decades,
};

// A connected graph of up to `most_nodes` nodes, at least two. Half of the networks with more than four
// have a part that inductors and current sources alone lead to, and half a triangle of capacitors. No
// voltage sources close a loop, no current sources a cut-set.
RandomNetwork random_network(std::mt19937& generator, Index most_nodes, Spread spread);

// What the constraint algorithm says of networks.
struct LadderTally {
  int count = 0;                 // of ladders
  int right = 0, ambiguous = 0;  // right ones may be ambiguous
  std::vector<std::string>
      wrong;  // and not ambiguous: what was expected and found, and the network
  int with_loops = 0, with_cut_sets = 0;
};

// Where the ladder of a network is computed: at one of the two states in turn, or at each.
enum class Starts { in_turn, each };

// Reads networks, and compares their ladders with
//
//   (n, n - d), and if d > 0 (n - d, n - d) after it;   index 0 if d = 0, else 1;   no gauge freedom
//
// where n counts charges and fluxes, d loops and cut-sets.
LadderTally tally_ladders(std::mt19937& generator, int networks, Index most_nodes, Spread spread,
                          Starts starts, const Campaign& campaign = {});

}  // namespace courant::test
