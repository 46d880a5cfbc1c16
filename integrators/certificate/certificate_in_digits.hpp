// The constraint algorithm in two precisions.
#pragma once

#include <memory>

#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/integrators/certificate/decider.hpp"
#include "courant/integrators/certificate/jet_equations.hpp"

namespace courant {

//   1. the zero of F^[k] nearest to the guess, to 256 bits                        NearestJet
//   2. the ranks of all levels ≤ k there, by one elimination                      StagedElimination
//   3. k = 0, 1, … until S_k and M_k have the dimensions of the level before
//   4. the ranks at consistent points nearby, which are the same where the set is a manifold    Neighbourhood
//
// A number is zero if and only if it shrinks when its digits double (Digits): no scale of equations, unknowns or time
// enters a decision. Time is a coordinate: what holds at an instant only is not consistent. A residual that
// stays is inconsistent. Of a regular or gauge ladder there is a proof where the decider asks for one. Throws
// std::invalid_argument on wrong sizes.
ConstraintLadder certificate_in_digits(const JetEquations& equations, const InitialGuess& guess,
                                       const ConstraintAlgorithm::Options& options = {},
                                       Decider decider = Decider::digits);

// The equations for that; null where bounds of errors are to decide.
std::shared_ptr<const JetEquations> equations_in_digits(
    const std::shared_ptr<const ChartEquations>& in_chart, Decider decider);

// The ladder by bounds with what digits say of the same guess:
//
//   bounds      digits                              the answer
//   doubted     sure, alike or with solutions       that of digits: what rounding hides from the first is seen by the other
//   sure        inconsistent                        that of digits: constants are zero or not, and time goes on
//   sure        sure, with other dimensions         that of bounds, with a doubt
//   either      at a switch, or near a point with   that of bounds, with this doubt; so also where bounds see such a point
//               other ranks
//   otherwise                                       that of bounds
//
// A search of digits that ended nowhere, or at a singular point, says nothing against bounds that are sure; and bounds
// that are sure of systems of more than 60 coordinates and unknowns are not asked about.
ConstraintLadder decided_together(ConstraintLadder by_bounds, const JetEquations& equations,
                                  const InitialGuess& guess,
                                  const ConstraintAlgorithm::Options& options);

}  // namespace courant
