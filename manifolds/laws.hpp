// The laws of Manifold, measured.
#pragma once

#include <cstdint>
#include <vector>

#include "courant/manifolds/law_result.hpp"
#include "courant/manifolds/manifold.hpp"

namespace courant {

// Where the laws of a manifold are measured.
struct LawOptions {
  std::uint32_t seed = 1;  // of the random points and vectors
  int points = 3;          // at which each law is measured; at least 1
};

// Every law of `manifold` (M1 to M9 in the comment of Manifold) at random points x, for tangent
// vectors of length 0, 1e-8, 1e-4, half the injectivity radius and 1 % inside it (where it is
// infinite: 0.5 and 2). Every defect is relative to the size of what is compared. Independent of
// the formulas that are measured: derivatives are held against sixth-order differences, the frame
// against the measured slope of the remainder, the range of the frame against the kernel of the
// constraint.
//
// Does not throw for a wrong manifold: what a map throws counts as an infinite defect of the law,
// and `where` says what it was.
std::vector<LawResult> check_manifold(const Manifold& manifold, const LawOptions& options = {});

}  // namespace courant
