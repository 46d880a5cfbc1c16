// Decider: what ranks are decided by.
#pragma once

#include <cstdint>

namespace courant {

// What decides whether a number is zero: bounds of errors in doubles; whether it shrinks when its digits double
// (docs/constraint-algorithm.md); or both, of systems with up to 120 coordinates and unknowns, where each settles what the
// other doubts, and where both are sure and differ there is a doubt. Larger systems are decided by bounds alone. A proof is
// decided by digits, and balls prove that what is not zero for these is not (LadderProof).
enum class Decider : std::uint8_t { both, digits, bounds, proof };

inline bool is_of_digits_alone(Decider decider) {
  return decider == Decider::digits || decider == Decider::proof;
}

}  // namespace courant
