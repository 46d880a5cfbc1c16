// Numbers that a formula knows while it is read, with the digits that decide whether they are zero.
#pragma once

#include <memory>
#include <optional>

#include "courant/core/numbers/digits.hpp"

namespace courant::formula {

// A double, and more of the number if that does not say all of it (else null).
struct KnownNumber {
  double value = 0.0;
  std::shared_ptr<const Digits> digits = {};
};

// op(a), op(a, b) of numbers as they are written: 0.1 + 0.2 - 0.3 is 0, cos(pi/2) is 0, and 1 - 3 (1/3) is 0. The value
// is the double next to the number, and 0 if and only if the number shrinks (Digits); a number that no decimal of a
// double is keeps its digits for the operations around it. Nothing where the result is not finite, or op is none of
// negate, add, subtract, multiply, divide, pow and the functions of one number.
std::optional<KnownNumber> known(Op op, const KnownNumber& a);
std::optional<KnownNumber> known(Op op, const KnownNumber& a, const KnownNumber& b);

}  // namespace courant::formula
