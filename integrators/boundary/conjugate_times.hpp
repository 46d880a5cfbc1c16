// Conjugate points of a motion between conditions at both ends.
#pragma once

#include <optional>
#include <vector>

#include "courant/integrators/boundary/shooting.hpp"

namespace courant {

// With V₀ a basis of the directions in T M_f at the start that keep the initial conditions, the Jacobi fields of the
// discrete motion are V_j = T(Φ_h)^j V₀. The times t_j, j ≥ 1, between which
//
//   det Wᵀ Dr_T(x_j) V_j,   W an orthonormal basis of the range of Dr_T(x_j) that turns with it,
//
// changes its sign, by linear interpolation: where an odd number of fields that vanish at the start, as the initial
// conditions see them, vanish once more as the final ones do (Jacobi's condition). No value unless the final conditions
// have as many independent ones as there are directions in V₀.
std::optional<std::vector<double>> conjugate_times(const Shooting& shooting, const State& start,
                                                   double h, long steps);

}  // namespace courant
