// Decider: what ranks are decided by.
#pragma once

#include <cstdint>

namespace courant {

// What decides whether a number is zero: bounds of errors in doubles; whether it shrinks when its digits double
// (docs/constraint-algorithm.md); or both, of systems with up to 120 coordinates and unknowns, where each settles what the
// other doubts, and where both are sure and differ there is a doubt. Larger systems are decided by bounds alone.
enum class Decider : std::uint8_t { both, digits, bounds };

}  // namespace courant
