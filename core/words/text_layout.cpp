#include "courant/core/words/text_layout.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "courant/core/words/message.hpp"

namespace courant {
namespace {

bool begins_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }

}  // namespace

std::string counted(std::ptrdiff_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

namespace {

using DigitSigns = std::array<const char*, 10>;

std::string in_signs(std::ptrdiff_t k, const DigitSigns& digits, const char* minus) {
  std::string text;
  for (const char digit : std::to_string(k))
    text += digit == '-' ? minus : digits[static_cast<std::size_t>(digit - '0')];
  return text;
}

}  // namespace

std::string subscript(std::ptrdiff_t k) {
  return in_signs(k, {"₀", "₁", "₂", "₃", "₄", "₅", "₆", "₇", "₈", "₉"}, "₋");
}

std::string superscript(std::ptrdiff_t k) {
  return in_signs(k, {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"}, "⁻");
}

std::string time_derivative(const std::string& name, std::ptrdiff_t order) {
  if (order == 0) return name;
  if (order == 1) return "d/dt " + name;
  const std::string k = std::to_string(order);
  return "d^" + k + "/dt^" + k + " " + name;
}

void add_term(std::string& sum, double coefficient, const std::string& name, int digits) {
  const bool is_negative = coefficient < 0.0;
  const std::string size = number_text(std::abs(coefficient), digits);
  sum += sum.empty() ? (is_negative ? "-" : "") : (is_negative ? " - " : " + ");
  sum += (size == "1" ? "" : size + " ") + name;
}

std::size_t text_width(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins_character));
}

std::string padded(std::string text, std::size_t width) {
  const std::size_t size = text_width(text);
  return size < width ? text.append(width - size, ' ') : text;
}

std::string shortened(const std::string& text, std::size_t width) {
  if (text_width(text) <= width) return text;
  std::string result;
  std::size_t count = 0;
  for (const char c : text) {
    if (begins_character(c) && ++count == width) break;
    result += c;
  }
  return result + "…";
}

std::string beginning(const std::string& text, std::size_t most) {
  if (text.size() <= most) return text;
  while (most > 0 && !begins_character(text[most])) --most;
  return text.substr(0, most);
}

std::string shortened_between(const std::string& text, std::size_t most, std::size_t ending) {
  if (text.size() <= most) return text;
  std::size_t last = text.size() - ending;
  while (last < text.size() && !begins_character(text[last])) ++last;
  return beginning(text, most - ending) + " … " + text.substr(last);
}

}  // namespace courant
