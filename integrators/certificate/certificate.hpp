// Certificate: what is certain of an implicit system near a point.
#pragma once

#include <memory>

#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/integrators/certificate/decider.hpp"

namespace courant {

// Verdict, levels, index, degrees of freedom, gauge dimension, the consistent point and what moved to get there,
// doubts.
using Certificate = ConstraintLadder;

// The constraint algorithm at the guess. Throws std::invalid_argument on wrong sizes.
Certificate certificate(const std::shared_ptr<const ImplicitSystem>& system,
                        const InitialGuess& guess, const ConstraintAlgorithm::Options& options = {},
                        Decider decider = Decider::both);

}  // namespace courant
