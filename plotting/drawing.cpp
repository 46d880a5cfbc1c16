#include "courant/plotting/drawing.hpp"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

#include "courant/plotting/digits.hpp"
#include "courant/plotting/palette.hpp"
#include "courant/plotting/scale.hpp"

namespace courant::plot {

namespace {

// A conversion that overflows is undefined.
float nearest_float(double value) {
  constexpr float most = std::numeric_limits<float>::max();
  if (std::abs(value) > static_cast<double>(most))
    return std::copysign(std::numeric_limits<float>::infinity(),
                         static_cast<float>(value < 0 ? -1 : 1));
  return static_cast<float>(value);
}

// How a variable of that name is set; "" for a word.
std::string_view variable(std::string_view name) {
  static const std::map<std::string_view, std::string_view> greek = {
      {"alpha", "α"}, {"beta", "β"},  {"gamma", "γ"}, {"delta", "δ"},  {"epsilon", "ε"},
      {"eta", "η"},   {"theta", "θ"}, {"kappa", "κ"}, {"lambda", "λ"}, {"mu", "μ"},
      {"nu", "ν"},    {"xi", "ξ"},    {"pi", "π"},    {"rho", "ρ"},    {"sigma", "σ"},
      {"tau", "τ"},   {"phi", "φ"},   {"chi", "χ"},   {"psi", "ψ"},    {"omega", "ω"},
      {"Delta", "Δ"}, {"Omega", "Ω"}, {"Phi", "Φ"},   {"Psi", "Ψ"},    {"Gamma", "Γ"}};
  if (name.size() == 1) return name;
  const auto found = greek.find(name);
  return found == greek.end() ? std::string_view() : found->second;
}

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

// "kg m²/s" of "kg m^2/s".
std::string unit_text(std::string_view unit) {
  std::string text;
  while (!unit.empty()) {
    std::size_t size = unit[0] != '^' ? 0 : unit.starts_with("^-") ? 2 : 1;
    const std::size_t sign = size;
    while (size > 0 && size < unit.size() && is_digit(unit[size])) ++size;
    if (size > sign) {
      text += superscript(unit.substr(1, size - 1));
    } else {
      size = 1;
      text += unit[0];
    }
    unit.remove_prefix(size);
  }
  return text;
}

// Of a quantity without its unit.
Markup name_of_quantity(std::string_view text) {
  const auto word = [](std::string_view from, bool with_digits) {
    const auto end = std::find_if(from.begin(), from.end(), [&](char c) {
      const auto letter = static_cast<unsigned char>(c);
      return std::isalpha(letter) == 0 && !(with_digits && std::isdigit(letter) != 0);
    });
    return from.substr(0, static_cast<std::size_t>(end - from.begin()));
  };
  Markup markup;
  while (!text.empty()) {
    const std::string_view name = word(text, false), symbol = variable(name);
    const std::size_t size = std::max<std::size_t>(1, name.size());
    markup += symbol.empty() ? Markup(text.substr(0, size))
                             : element("tspan", {{"font-style", "italic"}}, symbol);
    text.remove_prefix(size);
    if (symbol.empty() || !text.starts_with('_')) continue;
    const std::string_view index = word(text.substr(1), true);
    if (index.empty()) continue;
    const std::string_view letter = variable(index);
    markup += element("tspan", {{"dy", 3.0}, {"font-size", 9.0}, {"font-style", "italic"}},
                      letter.empty() ? index : letter);
    text.remove_prefix(1 + index.size());
    return text.empty() ? markup
                        : markup + element("tspan", {{"dy", -3.0}}, name_of_quantity(text));
  }
  return markup;
}

}  // namespace

std::string colour_class(std::size_t colour) {
  return "c" + std::to_string(colour % palette().size());
}
std::string_view ink(std::size_t colour) { return palette()[colour % palette().size()].light; }

Markup mathematics(std::string_view text) {
  const std::size_t unit = text.find(" [");
  const std::size_t end = text.find(']', std::min(unit, text.size()));
  if (end == std::string_view::npos) return name_of_quantity(text);
  return name_of_quantity(text.substr(0, unit)) + unit_text(text.substr(unit, end - unit)) +
         text.substr(end);
}

Markup text(double x, double y, std::string_view anchor, const Markup& content) {
  return element("text", {{"x", x}, {"y", y}, {"text-anchor", anchor}}, content);
}

Markup line(std::string_view style, double x1, double y1, double x2, double y2,
            std::string_view stroke) {
  return element(
      "line",
      {{"class", style}, {"x1", x1}, {"y1", y1}, {"x2", x2}, {"y2", y2}, {"stroke", stroke}});
}

Markup dot(std::string_view style, double x, double y, double radius, std::size_t colour) {
  return element("circle", {{"class", style},
                            {"cx", x},
                            {"cy", y},
                            {"r", radius},
                            {"stroke", ink(colour)},
                            {"stroke-width", 1.4},
                            {"fill", style == "start" ? "#fff" : ink(colour)}});
}

std::string number_list(std::initializer_list<double> numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : " ") + digits(number);
  return text;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    std::uint32_t bits = 0;
    for (std::size_t i = at; i < at + 3; ++i)
      bits = bits << 8 | (i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0u);
    for (std::size_t i = 0; i < 4; ++i)
      text += at + i <= bytes.size() ? letters[bits >> (18 - 6 * i) & 63] : '=';
  }
  return text;
}

std::string float_text(std::span<const double> values, std::span<const std::size_t> rows,
                       double origin) {
  std::string bytes;
  bytes.reserve(4 * rows.size());
  for (const std::size_t row : rows) {
    const auto bits = std::bit_cast<std::uint32_t>(nearest_float(values[row] - origin));
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(bits >> shift & 255u);
  }
  return base64(bytes);
}

}  // namespace courant::plot
