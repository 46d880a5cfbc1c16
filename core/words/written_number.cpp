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

// n/d with n, d up to these bounds; none if there are none.
std::optional<std::pair<int, int>> fraction(double value, int most_n = 100, int most_d = 24) {
  for (int d = 1; d <= most_d; ++d) {
    const double n = value * d;
    if (n > 0.5 && n < most_n + 0.5 && is_same_number(n, std::round(n)))
      return std::pair(static_cast<int>(std::lround(n)), d);
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
  if (is_decimal && decimal.size() <= 5) return {decimal, ""};
  if (const auto f = fraction(value)) return {text(f->first), text(f->second)};
  const auto times_pi = [](const std::string& n) { return n.empty() ? "pi" : n + "*pi"; };
  if (const auto f = fraction(value * std::numbers::pi))
    return {text(f->first), times_pi(text(f->second))};
  if (const auto f = fraction(value / std::numbers::pi))
    return {times_pi(text(f->first)), text(f->second)};
  if (is_decimal) return {decimal, ""};
  if (const auto f = fraction(value, 9999, 999)) return {text(f->first), text(f->second)};
  return {decimal, ""};
}

}  // namespace courant
