// Certificate: what is certain of an implicit system near a point.
#pragma once

#include <memory>

#include "courant/integrators/certificate/constraint_algorithm.hpp"

namespace courant {

// Verdict, levels, index, degrees of freedom, gauge dimension, the consistent point and what moved to reach it, doubts.
using Certificate = ConstraintLadder;

// The constraint algorithm in two precisions (docs/constraint-algorithm.md):
//
//   1. the zero of F^[k] nearest to the guess, to 256 bits                        NearestJet
//   2. the ranks of all levels ≤ k there, by one elimination                      StagedElimination
//   3. k = 0, 1, … until S_k and M_k have the dimensions of the level before
//   4. the ranks at consistent points nearby, which are the same where the set is a manifold    Neighbourhood
//
// A number is zero if and only if it shrinks when its digits double (Digits): no scale of equations, unknowns or time
// enters a decision. Time is a coordinate: what holds at an instant only is not consistent. A residual that
// stays is inconsistent. Throws std::invalid_argument on wrong sizes.
Certificate certificate(const std::shared_ptr<const ImplicitSystem>& system,
                        const InitialGuess& guess,
                        const ConstraintAlgorithm::Options& options = {});

// What decides ranks where both are offered, until the comparison of tests/integrators/certificate is won on every
// system: bounds of errors in doubles (ConstraintAlgorithm), or two precisions.
enum class Decider { bounds, digits };
ConstraintLadder constraint_ladder(const std::shared_ptr<const ImplicitSystem>& system,
                                   const InitialGuess& guess,
                                   const ConstraintAlgorithm::Options& options, Decider decider);

}  // namespace courant
