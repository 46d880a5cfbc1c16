// Ten starts for each system of the catalogue, of the kinds that people use.
#pragma once

#include "ladder_catalogue.hpp"

namespace courant::examples {

// A start, and what is right from there.
struct KnownStart {
  std::string kind;
  Problem problem;
  Verdict verdict;
  Dimensions dimensions;  // empty: only the verdict is known
};

// That of the catalogue, a generic point, all zeros, the first and the second axis, the first half
// alone (at rest), the zeros of a computed right angle, small numbers, sizes of SI units, and all
// numbers equal. On manifolds other than Rⁿ the same displacements from a point with zeros in it.
// The seed is that of the generic point.
std::vector<KnownStart> ten_starts(const KnownLadder& known, unsigned seed = 3);

// The same equations with something added to each that is zero but for rounding: (sin² a + cos² a - 1) w
// and products that cancel.
Problem with_planted_round_off(const Problem& problem, std::mt19937& generator);
Problem with_cancelled_products(const Problem& problem, std::mt19937& generator);

}  // namespace courant::examples
