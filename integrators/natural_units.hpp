// The sizes that are typical of a system's coordinates.
#pragma once

#include "courant/integrators/ladder/constraint_ladder.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

// What is a typical size of each of the Ñ numbers of a tangent vector of M, near the ladder's
// point: the units in which the terms of the equations are of one size,
//
//   Σ (log r_i + log |∂F_i/∂y_j| + log c_j)²  least,    c_ξ' = c_ξ / T,
//
// for y = (ξ, ξ', z), units r of the equations and T of time. An entry that vanishes at the point is
// taken as large as it is nearby, and a number that is zero up to round-off is no size. A change of
// units of the coordinates changes these sizes with them, up to a common factor of those that the
// equations connect. Numbers that the tangent projector of M mixes, as those of a sphere, share a
// unit. All 1 where the ladder has no point.
VectorXd natural_units(const std::shared_ptr<const ImplicitSystem>& system,
                       const ConstraintLadder& ladder);

}  // namespace courant
