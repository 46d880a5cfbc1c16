// How fast the motions of a linear system decay.
#pragma once

#include "courant/structures/implicit_system.hpp"

namespace courant {

// The greatest -Re λ of the generalised eigenvalues of F(x, λ x, z, 0) = 0, linearised at x with v = 0 and z = 0: of
// 1/time. 0 where nothing decays, for a system of more than 400 coordinates and unknowns, and where the equations are
// not as many as these. On Rⁿ.
double fastest_decay(const ImplicitSystem& system, const VectorXd& x);

}  // namespace courant
