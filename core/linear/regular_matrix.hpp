// What DenseSolver and SparseSolver take for a regular matrix. Not installed API: LinearSolver is.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace courant::regular_matrix {

// Below this ratio of pivots, after equilibration, a square matrix is taken as singular.
// Round-off alone gives about 1e-16 n; a step whose matrix is that near to singular has no
// meaningful digits to lose.
inline constexpr double kSingular = 1e-13;

// Above this one it is regular whatever its scales are.
inline constexpr double kRegular = 1e-7;

// Entries below this part of both their row and their column are left out when scales are chosen.
inline constexpr double kNoise = 1e-14;

// 2^-e for a number 2^e ≤ size < 2^(e+1), e from -1022 to 1022, from the bits of its exponent.
inline double inverse_power(double size) {
  constexpr std::uint64_t exponent = std::uint64_t{0x7ff} << 52,
                          of_one_twice = std::uint64_t{2046} << 52;
  return std::bit_cast<double>(of_one_twice - (std::bit_cast<std::uint64_t>(size) & exponent));
}

// Divides a scale by a power of two near the size that it led to.
inline void scale_to_one(double size, double& scale) {
  constexpr double least = std::numeric_limits<double>::min(), most = 0x1p1022;
  if (size >= least && size < most)
    scale *= inverse_power(size);
  else if (size > 0.0)
    scale = std::ldexp(scale, -std::ilogb(size));
}

}  // namespace courant::regular_matrix
