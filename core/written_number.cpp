#include "courant/core/written_number.hpp"

#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "courant/core/message.hpp"

namespace courant {

bool is_same_number(double a, double b) { return std::fabs(a - b) <= 4e-15 * std::fabs(b); }

namespace {

// n/d with small n, d; none if there are none.
std::optional<std::pair<int, int>> fraction(double value) {
  for (int d = 1; d <= 24; ++d) {
    const double n = value * d;
    if (n > 0.5 && n < 100.5 && is_same_number(n, std::round(n)))
      return std::pair(static_cast<int>(std::lround(n)), d);
  }
  return std::nullopt;
}

}  // namespace

WrittenNumber written_number(double value) {
  const auto text = [](int n) { return n == 1 ? std::string() : std::to_string(n); };
  if (value == 1.0) return {};
  const std::string decimal = number_text(value);
  double read = 0.0;
  std::from_chars(decimal.data(), decimal.data() + decimal.size(), read);
  if (read == value && decimal.size() <= 5) return {decimal, ""};
  if (const auto f = fraction(value)) return {text(f->first), text(f->second)};
  const auto times_pi = [](const std::string& n) { return n.empty() ? "pi" : n + "*pi"; };
  if (const auto f = fraction(value * std::numbers::pi))
    return {text(f->first), times_pi(text(f->second))};
  if (const auto f = fraction(value / std::numbers::pi))
    return {times_pi(text(f->first)), text(f->second)};
  return {decimal, ""};
}

}  // namespace courant
