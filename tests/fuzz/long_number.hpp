// What is left out of the fuzzed texts.
#pragma once

#include <cstddef>
#include <string>

namespace courant::fuzz {

// Whether a number of six digits or more is in it. Sums of so many terms are allowed, and take seconds
// with the sanitizers; they find nothing that short ones do not, and tests/core holds their bounds.
inline bool has_long_number(const std::string& text) {
  std::size_t digits = 0;
  for (const char letter : text) {
    digits = letter >= '0' && letter <= '9' ? digits + 1 : 0;
    if (digits > 5) return true;
  }
  return false;
}

}  // namespace courant::fuzz
