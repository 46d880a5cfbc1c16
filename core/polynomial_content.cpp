#include "courant/core/polynomial_content.hpp"

#include <algorithm>
#include <cmath>

#include "courant/core/written_number.hpp"

namespace courant {
namespace {

Monomial common_monomial(const Polynomial& polynomial) {
  Monomial common = polynomial.begin()->first;
  for (const auto& [monomial, c] : polynomial) {
    std::map<int, int> powers(monomial.begin(), monomial.end());
    Monomial least;
    for (const auto& [factor, exponent] : common) {
      const auto found = powers.find(factor);
      const int other = found == powers.end() ? 0 : found->second;
      if (const int both = std::min(exponent, other); both != 0) least.emplace_back(factor, both);
      if (found != powers.end()) powers.erase(found);
    }
    for (const auto& [factor, exponent] : powers)
      if (exponent < 0) least.emplace_back(factor, exponent);
    std::sort(least.begin(), least.end());
    common = least;
  }
  return common;
}

double common_number(const Polynomial& polynomial, const FactorTable& factors) {
  const double lead = factors.in_order(polynomial).front().second;
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
