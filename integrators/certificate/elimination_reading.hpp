// What an elimination says of a ladder that ended.
#pragma once

#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/integrators/certificate/nearest_jet.hpp"
#include "courant/integrators/certificate/staged_elimination.hpp"

namespace courant {

// Levels 0 … k by their dimensions and ranks.
std::vector<LadderLevel> levels_of(const JetEquations& equations,
                                   const StagedElimination& elimination, Index k);

// The point (t, x, v, z), and the jet in the chart at x, as Prolongation has it.
State state_of(const JetEquations& equations, const Jet& jet);
VectorXd chart_jet(const JetEquations& equations, const Jet& jet);

// Constraints, redundancies, gauge directions, and what is determined. The ladder has its levels and its index.
void describe(ConstraintLadder& ladder, const JetEquations& equations,
              const StagedElimination& elimination, const Jet& jet);

// How often each equation is differentiated for what the rows of levels ≤ index say of point and velocity.
std::vector<int> differentiations(const JetEquations& equations,
                                  const StagedElimination& elimination, Index index);

// The equations that a row is a combination of.
std::vector<NamedEquation> equations_of(const JetEquations& equations,
                                        const StagedElimination& elimination,
                                        const StagedElimination::Row& row);

}  // namespace courant
