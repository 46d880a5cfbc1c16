// Decider: what ranks are decided by.
#pragma once

#include <cstdint>

namespace courant {

// What decides whether a number is zero: whether it shrinks when its digits double (docs/constraint-algorithm.md), or
// bounds of errors in doubles; or the first of systems with up to 120 coordinates and unknowns, where its search ends
// at a point that is not singular, and the second of others.
enum class Decider : std::uint8_t { either, digits, bounds };

}  // namespace courant
