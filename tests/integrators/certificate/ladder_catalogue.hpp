// The table of systems whose ladders are known.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "../example_systems.hpp"
#include "courant/structures/generating_family.hpp"

namespace courant::examples {

// (dim S_k, dim M_k) for k = 0, 1, …; of an empty level (-1, -1).
using Dimensions = std::vector<std::pair<Index, Index>>;
Dimensions dimensions(const ConstraintLadder& ladder);

struct KnownLadder {
  std::string name;
  Problem problem;
  Dimensions dimensions;  // to the confirming level; empty: only the verdict is known
  Verdict verdict;
  Index index;
  Index redundant = 0;  // equations of level 0 that follow from the others at the point
};

// The Dirac system of a Lagrangian on T*R^n.
SystemPointer lagrangian(Index n, Lagrangian::Formula L, ImplicitSystem::Names names = {});
// Equations on Rⁿ with m auxiliary unknowns.
SystemPointer flat(Index n, Index m, Index equation_count, FormulaSystem::Formula formula,
                   ImplicitSystem::Names names = {});
InitialGuess at(std::initializer_list<double> x);

SystemPointer vortices();  // four, Section 6.3, with H of equation (9)
InitialGuess vortex_guess();
SystemPointer cartesian_pendulum();
// (27) with ports closed: H = (p² + r²)/2 + q²/2 + q⁴/4 + s² on (q, s, p, r), B = ∂_s/2 + ∂_r.
SystemPointer closed_port_hamiltonian();

std::vector<KnownLadder> errata();     // the six of the errata
std::vector<KnownLadder> catalogue();  // these and all others

}  // namespace courant::examples
