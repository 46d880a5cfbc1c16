// The constraint algorithm in two precisions.
#pragma once

#include <memory>
#include <optional>

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
// stays is inconsistent. Throws std::invalid_argument on wrong sizes.
ConstraintLadder certificate_in_digits(const JetEquations& equations, const InitialGuess& guess,
                                       const ConstraintAlgorithm::Options& options = {});

// The equations for that; null where bounds of errors are to decide.
std::shared_ptr<const JetEquations> equations_in_digits(
    const std::shared_ptr<const ImplicitSystem>& system, Decider decider);

// The certificate; where bounds may decide as well nothing if x had to move, the search for a point did not end, points
// nearby do not agree, or the point is singular: bounds look at given points, as the fold of an impasse, in more ways.
std::optional<ConstraintLadder> decided_in_digits(const JetEquations& equations,
                                                  const InitialGuess& guess,
                                                  const ConstraintAlgorithm::Options& options,
                                                  Decider decider);

}  // namespace courant
