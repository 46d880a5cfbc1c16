// A number as people write it in a formula.
#pragma once

#include <string>

namespace courant {

// A positive number as factors above and below a fraction line; "" stands for 1.
//
//   2.5   2.5 above        1/2   2 below        π/4   pi above, 4 below        1/(2π)   2*pi below
//
// A half, a quarter, an eighth, other short decimals as they are, fractions with denominators of up to 24, the same
// times π or 1/π; else six digits if these are all there are, then fractions of up to four digits over four, then six
// digits.
struct WrittenNumber {
  std::string above, below;
};
WrittenNumber written_number(double value);

// Whether two numbers differ by no more than the rounding of a few operations.
bool is_same_number(double a, double b);

}  // namespace courant
