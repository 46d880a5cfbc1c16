// The digits of a number.
#pragma once

#include <charconv>
#include <string>

namespace courant::plot {

// As std::to_chars writes them: the fewest that read back to the same number, or in a format with so
// many digits.
template <class... Format>
std::string digits(double value, Format... format) {
  char buffer[400];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value, format...).ptr};
}

}  // namespace courant::plot
