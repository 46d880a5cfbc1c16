// The starting procedure of Method 1 from two positions.
#pragma once

#include <memory>

#include "courant/integrators/maps/discretization_map.hpp"
#include "courant/integrators/step/integrator.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

// The state (q₀, p₀) ∈ T*Q from which one step of Method 1 leads to the position q₁:
//
//   (1/h) R_d⁻¹((q₀, p₀), (q₁, p₁)) ∈ S,      solved for p₀, p₁ and the auxiliary unknowns.
//
// For a Lagrangian p₀ = -D₁L_d(q₀, q₁) (Section 6.1): what a two-step method gets when its second
// position comes from elsewhere. q₀ and the starting values for p₀, z are those of `initial`.
// Throws std::invalid_argument unless the system is on a cotangent bundle and the map has a closed
// inverse, SolveError if there is no such momentum.
State starting_procedure(const ImplicitSystem& system, const DiscretizationMap& map,
                         const State& initial, const VectorXd& q1, double h);

}  // namespace courant
