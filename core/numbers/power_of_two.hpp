// Units that change no digits of a number.
#pragma once

#include <cmath>

namespace courant {

// The power of two that is nearest to a size, by its logarithm. Numbers are divided by it and restored to the
// last bit. The size is positive and finite.
inline double nearest_power_of_two(double size) { return std::exp2(std::round(std::log2(size))); }

// Whether a number is one, or the negative of one.
inline bool is_power_of_two(double number) {
  int exponent = 0;
  return std::fabs(std::frexp(number, &exponent)) == 0.5;
}

}  // namespace courant
