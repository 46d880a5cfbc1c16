// The words of messages: numbers, and what an error says without its place in the code.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace courant {

// A number in a message: at most `digits` significant digits, as many as needed, "0.1", "1.6e-07",
// "nan", "-inf". A number that is not zero never reads as zero.
std::string number_text(double value, int digits = 6);

// The fewest digits that read back to the same double.
std::string exact_text(double value);

// The size of a matrix, "3 × 4".
std::string size_text(std::ptrdiff_t rows, std::ptrdiff_t columns);

// What the message of a library error says to somebody who called no function of the library: without
// the place in front, so that
//
//   Sphere(2, exponential)::retract: x has 2 entries, expected 3.
//
// gives "x has 2 entries, expected 3." Names with a hyphen, which are those of methods, stay.
std::string without_place(std::string_view message);

// The text between quotation marks.
std::string in_quotes(std::string_view text);

// Without what would command a terminal: control characters, separators of lines and marks of direction as
// \u001b, everything else as it is.
std::string printable(std::string_view text);

}  // namespace courant
