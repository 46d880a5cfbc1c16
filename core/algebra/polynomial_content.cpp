#include "courant/core/algebra/polynomial_content.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "courant/core/words/written_number.hpp"

namespace courant {
namespace {

Monomial common_monomial(const Polynomial& polynomial) {
  Monomial common = polynomial.begin()->first;
  for (const auto& [monomial, c] : polynomial)
    common = combined(common, monomial, [](int a, int b) { return std::min(a, b); });
  return common;
}

// The number p/q by which all coefficients over `lead` are integers without a common divisor, where q is at most 48; else 1.
double common_fraction(const Polynomial& polynomial, double lead) {
  constexpr int largest = 48;
  constexpr double most = 1e6, round_off = 1e-12;
  for (int q = 1; q <= largest; ++q) {
    std::int64_t divisor = 0;
    const bool are_integers = std::ranges::all_of(polynomial, [&](const auto& term) {
      const double number = term.second / lead * q, integer = std::round(number);
      // Both are false of NaN, which a quotient of numbers that overflowed is.
      if (!(std::fabs(integer) < most) ||
          !(std::fabs(number - integer) <= round_off * std::fabs(number)))
        return false;
      divisor = std::gcd(divisor, static_cast<std::int64_t>(integer));
      return true;
    });
    if (are_integers && divisor > 0) return static_cast<double>(divisor) / q;
  }
  return 1.0;
}

double common_number(const Polynomial& polynomial, const FactorTable& factors) {
  const double lead = factors.first_in_order(polynomial).second;
  double smallest = lead, largest = lead;
  for (const auto& [monomial, c] : polynomial) {
    if (std::fabs(c) < std::fabs(smallest)) smallest = std::copysign(c, lead);
    if (std::fabs(c) > std::fabs(largest)) largest = std::copysign(c, lead);
  }
  const auto letters = [&](double number) {
    std::size_t count = 0;
    for (const auto& [monomial, c] : polynomial) {
      const WrittenNumber written = written_number(std::fabs(c / number));
      count += written.above.size() + written.below.size() + (written.below.empty() ? 0 : 1);
    }
    return count;
  };
  double best = lead;
  std::size_t fewest = letters(lead);
  for (const double other : {smallest, largest, lead * common_fraction(polynomial, lead)}) {
    if (other == lead) continue;
    if (const std::size_t count = letters(other); count < fewest) {
      fewest = count;
      best = other;
    }
  }
  return best;
}

}  // namespace

PolynomialContent content(const Polynomial& polynomial, const FactorTable& factors) {
  PolynomialContent result;
  if (polynomial.empty()) return result;
  result.monomial = common_monomial(polynomial);
  result.number = common_number(polynomial, factors);
  for (const auto& [monomial, c] : polynomial)
    result.primitive_part[product(monomial, result.monomial, -1)] = c / result.number;
  return result;
}

}  // namespace courant
