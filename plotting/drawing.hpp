// Pieces that pictures are drawn of: text, lines, colours, and the numbers of curves for a script.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "courant/plotting/svg.hpp"

namespace courant::plot {

// The class of a colour in the style sheet, and the colour itself where there is no style sheet.
std::string colour_class(std::size_t colour);
std::string_view ink(std::size_t colour);

// A name as one sets it: single letters and the names of Greek ones are variables, and stand in
// italics; what follows one after an underscore is its subscript. A unit in brackets behind it stays
// upright, with its powers raised: "p [kg m²/s]".
Markup mathematics(std::string_view text);

Markup text(double x, double y, std::string_view anchor, const Markup& content);
Markup line(std::string_view style, double x1, double y1, double x2, double y2,
            std::string_view stroke);
// A dot at a point of a curve; `style` is "start", which is hollow, or "end".
Markup dot(std::string_view style, double x, double y, double radius, std::size_t colour);

// Numbers with all their digits and a space between, for an attribute.
std::string number_list(std::initializer_list<double> numbers);

// Bytes as letters: 4 for 3 of them.
std::string base64(std::string_view bytes);

// values[row] - origin of some rows, as float32, little-endian, in base64: 16 letters for three.
// What is beyond the range of a float32 becomes infinite.
std::string float_text(std::span<const double> values, std::span<const std::size_t> rows,
                       double origin = 0);

}  // namespace courant::plot
