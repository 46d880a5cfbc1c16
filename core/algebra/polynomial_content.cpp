#include "courant/core/algebra/polynomial_content.hpp"

#include <algorithm>
#include <cmath>

#include "courant/core/words/written_number.hpp"

namespace courant {
namespace {

Monomial common_monomial(const Polynomial& polynomial) {
  Monomial common = polynomial.begin()->first;
  for (const auto& [monomial, c] : polynomial)
    common = combined(common, monomial, [](int a, int b) { return std::min(a, b); });
  return common;
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
  for (const double other : {smallest, largest}) {
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
