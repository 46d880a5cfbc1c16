// Units that change no digits of a number.
#pragma once

#include <cmath>

namespace courant {

// The power of two that is nearest to a size, by its logarithm. Numbers are divided by it and restored to the
// last bit. The size is positive and finite.
inline double nearest_power_of_two(double size) { return std::exp2(std::round(std::log2(size))); }

}  // namespace courant
