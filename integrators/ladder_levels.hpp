// The levels of a ladder at a solution of a prolongation.
#pragma once

#include <random>

#include "courant/integrators/constraint_ladder.hpp"
#include "courant/integrators/prolongation.hpp"

namespace courant {

// dim S_k and dim M_k for k = 0 … level of y, at a zero y of the prolongation, with the ranks that
// they come from: π_A(ker J) has dimension |A| - (rank J - rank J_rest), where J_rest lacks the
// columns in A.
std::vector<LadderLevel> ladder_levels(const Prolongation& array, const VectorXd& y,
                                       const RankOptions& options);

// Fills in what row reduction of the Jacobian tells: constraints, differentiations, redundancies,
// gauge directions and determined auxiliary unknowns. `ladder` has its levels and index; y is of
// the last level.
class DerivativeArray;
void describe(ConstraintLadder& ladder, const DerivativeArray& array, const VectorXd& y);

// A random displacement of x_0 by 10⁻³ of the natural size of the unknowns: small against the scale
// on which a system changes, large against the error of a zero, so that a rank that is lost at y
// only is seen.
VectorXd small_displacement(const Prolongation& array, const VectorXd& y, std::mt19937& generator);

}  // namespace courant
