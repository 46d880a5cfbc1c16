// What DenseSolver and SparseSolver take for a regular matrix. Not installed API: LinearSolver is.
#pragma once

#include <cmath>

namespace courant::regular_matrix {

// Below this ratio of pivots, after equilibration, a square matrix is taken as singular.
// Round-off alone gives about 1e-16 n; a step whose matrix is that near to singular has no
// meaningful digits to lose.
inline constexpr double kSingular = 1e-13;

// Above this one it is regular whatever its scales are.
inline constexpr double kRegular = 1e-7;

// Entries below this part of both their row and their column are left out when scales are chosen.
inline constexpr double kNoise = 1e-14;

// Divides a scale by a power of two near the size that it led to.
inline void scale_to_one(double size, double& scale) {
  if (size > 0.0) scale = std::ldexp(scale, -std::ilogb(size));
}

}  // namespace courant::regular_matrix
