// Pieces of text that several rooms set: counts, terms of sums, derivatives, small digits, columns.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace courant {

// "1 term", "3 terms".
std::string counted(std::ptrdiff_t count, const std::string& noun);

// k in small digits: "₁₂".
std::string subscript(std::ptrdiff_t k);
// k in raised digits: "¹²".
std::string superscript(std::ptrdiff_t k);

// The derivative of this order by t: "F", "d/dt F", "d^2/dt^2 F".
std::string time_derivative(const std::string& name, std::ptrdiff_t order);

// Appends c·name to a sum that begins empty: "-2 a", then "-2 a + 0.5 b", then "-2 a + 0.5 b - c".
void add_term(std::string& sum, double coefficient, const std::string& name, int digits);

// The characters of a text in UTF-8. The texts of this library have characters one column wide.
std::size_t text_width(std::string_view text);

// With spaces behind it up to this width.
std::string padded(std::string text, std::size_t width);

// Its beginning and "…", if it is wider.
std::string shortened(const std::string& text, std::size_t width);
// Its beginning of up to so many bytes, without a part of a character.
std::string beginning(const std::string& text, std::size_t most);
// Its beginning, " … " and so many bytes of its ending, if it has more bytes than `most`; without parts of characters.
std::string shortened_between(const std::string& text, std::size_t most, std::size_t ending);

}  // namespace courant
