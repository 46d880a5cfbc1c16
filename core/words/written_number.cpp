#include "courant/core/words/written_number.hpp"

#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "courant/core/words/message.hpp"

namespace courant {

bool is_same_number(double a, double b) { return std::fabs(a - b) <= 4e-15 * std::fabs(b); }

namespace {

// n/d with n, d up to these bounds; none if there are none. Such a number is one of the convergents of its
// continued fraction.
std::optional<std::pair<int, int>> fraction(double value, int most_n = 100, int most_d = 24) {
  double n = 1.0, d = 0.0, n_before = 0.0, d_before = 1.0, rest = value;
  while (std::isfinite(rest)) {
    const double whole = std::floor(rest);
    n_before = std::exchange(n, whole * n + n_before);
    d_before = std::exchange(d, whole * d + d_before);
    if (n > most_n || d > most_d) break;
    if (n > 0.0 && is_same_number(value, n / d))
      return std::pair(static_cast<int>(n), static_cast<int>(d));
    rest = 1.0 / (rest - whole);
  }
  return std::nullopt;
}

}  // namespace

WrittenNumber written_number(double value) {
  const auto text = [](int n) { return n == 1 ? std::string() : std::to_string(n); };
  if (is_same_number(value, 1.0)) return {};
  const std::string decimal = number_text(value);
  double read = 0.0;
  std::from_chars(decimal.data(), decimal.data() + decimal.size(), read);
  const bool is_decimal = is_same_number(value, read);
  for (const int d : {2, 4, 8})
    if (value * d == 1.0) return {"", text(d)};
  if (is_decimal && decimal.size() <= 5) return {decimal, ""};
  if (const auto f = fraction(value)) return {text(f->first), text(f->second)};
  const auto times_pi = [](const std::string& n) { return n.empty() ? "pi" : n + "*pi"; };
  if (const auto f = fraction(value * std::numbers::pi))
    return {text(f->first), times_pi(text(f->second))};
  if (const auto f = fraction(value / std::numbers::pi))
    return {times_pi(text(f->first)), text(f->second)};
  if (is_decimal) return {decimal, ""};
  if (const auto f = fraction(value, 9999, 9999)) return {text(f->first), text(f->second)};
  return {decimal, ""};
}

}  // namespace courant
