// Decider: what ranks are decided by.
#pragma once

#include <cstdint>

namespace courant {

// What decides whether a number is zero.
//
// * bounds: bounds of errors in doubles.
// * digits: whether the number shrinks when its digits double (docs/constraint-algorithm.md).
// * both: each settles what the other doubts; where both are sure and differ there is a doubt. This is for systems with
//   up to 120 coordinates and unknowns. Larger systems are decided by bounds alone.
// * proof: digits, and balls prove that what is not zero for these is not (LadderProof).
enum class Decider : std::uint8_t { both, digits, bounds, proof };

inline bool is_of_digits_alone(Decider decider) {
  return decider == Decider::digits || decider == Decider::proof;
}

}  // namespace courant
