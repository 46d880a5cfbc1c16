#include "courant/core/numbers/meant_number.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string_view>

namespace courant {
namespace {

MeantNumber shortest_decimal(double number) {
  char text[40];
  const auto end =
      std::to_chars(text, text + sizeof text, std::fabs(number), std::chars_format::scientific).ptr;
  const std::string_view written(text, static_cast<std::size_t>(end - text));
  const std::size_t e = written.find('e');
  MeantNumber result;
  result.is_negative = number < 0;
  for (const char c : written.substr(0, e))
    if (c != '.') result.digits += c;
  const std::string_view power = written.substr(e + 1 + (written[e + 1] == '+' ? 1 : 0));
  std::from_chars(power.data(), power.data() + power.size(), result.exponent);
  result.exponent -= static_cast<int>(result.digits.size()) - 1;
  return result;
}

// With p and q of at most three digits.
std::optional<MeantNumber::Fraction> near_fraction(double number) {
  constexpr int most = 400;
  for (const int power : {0, 1, -1}) {
    const double a = power == 0   ? std::fabs(number)
                     : power == 1 ? std::fabs(number) / std::numbers::pi
                                  : std::fabs(number) * std::numbers::pi;
    if (a < 1.0 / most || a > most) continue;
    for (int q = 1; q <= most; ++q) {
      const double p = std::round(a * q);
      if (p < 1 || p > most || std::fabs(a * q - p) > 1e-15 * p) continue;
      return MeantNumber::Fraction{static_cast<int>(p), q, power};
    }
  }
  return std::nullopt;
}

// The double nearest to it.
double rounded(const MeantNumber::Fraction& fraction) {
  using Number = boost::multiprecision::cpp_bin_float_quad;
  return static_cast<double>(fraction.value<Number>(acos(Number(-1))));
}

}  // namespace

MeantNumber meant_number(double number) {
  // Longer decimals are results of a division, or of π, as likely as decimals.
  constexpr std::size_t long_decimal = 15;
  MeantNumber result = shortest_decimal(number);
  if (result.digits.size() < long_decimal) return result;
  const auto fraction = near_fraction(number);
  if (fraction && rounded(*fraction) == std::fabs(number)) result.fraction = fraction;
  return result;
}

}  // namespace courant
