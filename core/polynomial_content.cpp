#include "courant/core/polynomial_content.hpp"

#include <algorithm>
#include <cmath>

#include "courant/core/written_number.hpp"

namespace courant {
namespace {

// The lower power of each factor; what stands in one of them only has the power 0 in the other.
Monomial lower_powers(const Monomial& a, const Monomial& b) {
  Monomial lower;
  const auto add = [&](int factor, int power) {
    if (power != 0) lower.emplace_back(factor, power);
  };
  auto i = a.begin();
  auto j = b.begin();
  while (i != a.end() || j != b.end()) {
    if (j == b.end() || (i != a.end() && i->first < j->first)) {
      add(i->first, std::min(i->second, 0));
      ++i;
    } else if (i == a.end() || j->first < i->first) {
      add(j->first, std::min(j->second, 0));
      ++j;
    } else {
      add(i->first, std::min(i->second, j->second));
      ++i, ++j;
    }
  }
  return lower;
}

Monomial common_monomial(const Polynomial& polynomial) {
  Monomial common = polynomial.begin()->first;
  for (const auto& [monomial, c] : polynomial) common = lower_powers(common, monomial);
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
