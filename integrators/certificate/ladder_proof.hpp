// A proof of what a ladder says, by arithmetic with balls.
#pragma once

#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/integrators/certificate/jet_equations.hpp"
#include "courant/integrators/certificate/staged_elimination.hpp"

namespace courant {

// Of a consistent jet and the ranks that an elimination found there.
LadderProof proof(const JetEquations& equations, const StagedElimination& elimination,
                  const Jet& jet);

}  // namespace courant
