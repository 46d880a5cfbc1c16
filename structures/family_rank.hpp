// The rank condition of Morse families.
#pragma once

#include "courant/core/linear/rank_decision.hpp"
#include "courant/structures/generating_family.hpp"

namespace courant {

// A point of 𝓛: ∂_λE(x, λ, t) = 0.
struct FamilyPoint {
  VectorXd x, lambda;
  double t = 0.0;
};

// The rank of ∂_λ(∂_xE, ∂_λE), an (n + k) × k matrix, at a point of 𝓛, with ∂_x along an orthonormal
// basis of the tangent space. Where it is k, the number of parameters, E is a Morse family and 𝓛 a
// Lagrangian submanifold. Throws std::domain_error if a derivative is not finite there.
RankDecision family_rank(const GeneratingFamily& family, const FamilyPoint& at);

}  // namespace courant
