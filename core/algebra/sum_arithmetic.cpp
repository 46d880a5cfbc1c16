#include "courant/core/algebra/sum_arithmetic.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

#include "courant/core/algebra/polynomial_content.hpp"
#include "courant/core/algebra/polynomial_quotient.hpp"

namespace courant {
namespace {

Monomial power(Monomial a, int k) {
  if (k == 0) return {};
  for (auto& [factor, exponent] : a) exponent *= k;
  return a;
}

bool is_number(const Polynomial& sum) {
  return sum.empty() || (sum.size() == 1 && sum.begin()->first.empty());
}

PolynomialReduction::Options limits(const SumArithmetic::Options& options) {
  if (!options.add_fractions) return {};
  return {.most_terms = 400, .most_work = 100'000, .in_cosines = true};
}

}  // namespace

SumArithmetic::SumArithmetic(Options options) : options_(options), reduction_(limits(options)) {}

Polynomial SumArithmetic::number(double value) {
  return value == 0.0 ? Polynomial{} : Polynomial{{Monomial{}, value}};
}

Polynomial SumArithmetic::factor(FactorTable::Factor factor) {
  return {{{{factors_.number(std::move(factor)), 1}}, 1.0}};
}

Polynomial SumArithmetic::scaled(Polynomial sum, double factor) {
  for (auto& [monomial, c] : sum) c *= factor;
  return sum;
}

Polynomial SumArithmetic::times(const Polynomial& a, const Polynomial& b) {
  const std::size_t terms = a.size() * b.size();
  const std::size_t most_terms = options_.add_fractions ? 400 : 48;
  const bool expand = options_.expand;
  const bool distribute = a.size() <= 1 || b.size() <= 1 ? expand || is_number(a) || is_number(b)
                                                         : expand && terms <= most_terms;
  if (!distribute && terms > 0) {
    const auto [of_a, c] = as_factor(a);
    const auto [of_b, d] = as_factor(b);
    return opened({{normal(product(of_a, of_b)), c * d}});
  }
  Polynomial result;
  for (const auto& [of_a, c] : a)
    for (const auto& [of_b, d] : b) reduction_.add(result, normal(product(of_a, of_b)), c * d);
  return reduction_.reduced(std::move(result));
}

Polynomial SumArithmetic::to_power(const Polynomial& sum, int k) {
  if (k == 0) return number(1.0);
  if (sum.empty()) {
    if (k < 0) throw std::domain_error("SumArithmetic::to_power: the sum is 0 in a denominator.");
    return sum;
  }
  if (k > 1 && sum.size() > 1 && options_.expand && sum.size() <= 4 && k <= 3) {
    Polynomial result = sum;
    for (int i = 1; i < k; ++i) result = times(result, sum);
    return result;
  }
  const auto [monomial, c] = as_factor(options_.add_fractions && k < 0 ? as_fraction(sum) : sum);
  if (c == 0.0) throw std::domain_error("SumArithmetic::to_power: the sum is 0 as a fraction.");
  return opened({{normal(power(monomial, k)), std::pow(c, k)}});
}

Polynomial SumArithmetic::factored(const Polynomial& sum) {
  if (sum.size() < 2) return sum;
  const PolynomialContent of = content(sum, factors_);
  return {{normal(product(of.monomial, {{parentheses(of.primitive_part), 1}})), of.number}};
}

Polynomial SumArithmetic::collected(const Polynomial& sum) {
  std::map<Monomial, Polynomial> over;
  for (const auto& [monomial, c] : sum) {
    Monomial below;
    for (const auto& [factor, exponent] : monomial)
      if (exponent < 0 && factors_[factor].is_sum) below.emplace_back(factor, exponent);
    over[below][product(monomial, below, -1)] = c;
  }
  Polynomial result;
  for (const auto& [below, above] : over) {
    if (below.empty()) {
      for (const auto& [monomial, c] : above) reduction_.add(result, monomial, c);
      continue;
    }
    const auto [monomial, c] = as_factor(above);
    reduction_.add(result, normal(product(monomial, below)), c);
  }
  return result;
}

Polynomial SumArithmetic::as_fraction(const Polynomial& sum) {
  std::map<int, int> powers;
  for (const auto& [monomial, c] : sum)
    for (const auto& [factor, exponent] : monomial)
      if (exponent < 0) powers[factor] = std::max(powers[factor], -exponent);
  if (powers.empty()) return sum;
  const Monomial below(powers.begin(), powers.end());
  Polynomial above;
  for (const auto& [monomial, c] : sum) {
    Polynomial term = {{Monomial{}, c}};
    for (const auto& [factor, exponent] : product(monomial, below)) {
      const FactorTable::Factor& entry = factors_[factor];
      if (!entry.is_sum)
        term = times(term, {{{{factor, exponent}}, 1.0}});
      else
        for (int i = 0; i < exponent; ++i) term = times(term, entry.sum);
    }
    above = plus(above, term);
  }
  for (auto& [factor, exponent] : powers) {
    const FactorTable::Factor& entry = factors_[factor];
    while (entry.is_sum && exponent > 0) {
      const std::optional<Polynomial> fewer =
          courant::quotient(above, entry.sum, reduction_.circles());
      if (!fewer) break;
      above = *fewer;
      --exponent;
    }
  }
  std::erase_if(powers, [](const auto& entry) { return entry.second == 0; });
  const auto [monomial, c] = as_factor(with_sines(above, reduction_.circles()));
  if (c == 0.0) return {};
  return opened({{normal(product(monomial, {powers.begin(), powers.end()}, -1)), c}});
}

Polynomial SumArithmetic::equation(const Polynomial& sum, bool divides) {
  if (sum.empty()) return sum;
  const PolynomialContent of = content(sum, factors_);
  Monomial above;
  for (const auto& [factor, exponent] : of.monomial)
    if (exponent > 0 && !factors_[factor].is_parameter) above.emplace_back(factor, exponent);
  Monomial
      below;  // what all parameters of the primitive part stand over: no power is positive then
  if (divides)
    for (const auto& [monomial, c] : of.primitive_part)
      below = combined(below, factors_.divided(monomial).first,
                       [](int a, int b) { return std::max(a, b); });
  Polynomial result;
  for (const auto& [monomial, c] : of.primitive_part)
    result[product(product(monomial, above), below, -1)] = of.number * c;
  return divides ? result : without_sums_of_parameters(std::move(result));
}

// Multiplied out: M (m + M) - M² is m M.
Polynomial SumArithmetic::without_sums_of_parameters(Polynomial sum) {
  const auto is_one = [&](const std::pair<int, int>& power) {
    const FactorTable::Factor& factor = factors_[power.first];
    return factor.is_sum && power.second > 0 &&
           std::ranges::all_of(factor.sum, [&](const auto& term) {
             return factors_.divided(term.first).second.empty();
           });
  };
  const auto has_one = [&](const auto& term) { return std::ranges::any_of(term.first, is_one); };
  while (std::ranges::any_of(sum, has_one)) {
    Polynomial result;
    for (const auto& [monomial, c] : sum) {
      const auto power = std::ranges::find_if(monomial, is_one);
      if (power == monomial.end()) {
        reduction_.add(result, monomial, c);
        continue;
      }
      const Monomial rest = product(monomial, {{power->first, 1}}, -1);
      for (const auto& [term, d] : factors_[power->first].sum)
        reduction_.add(result, product(rest, term), c * d);
    }
    sum = std::move(result);
  }
  return sum;
}

double SumArithmetic::leading(const Polynomial& sum) const {
  return sum.empty() ? 1.0 : factors_.in_descending_order(sum).front().second;
}

std::string SumArithmetic::text(const Polynomial& sum) {
  const Polynomial other = with_coefficients(sum);
  std::string text = factors_.text(sum);
  if (other == sum) return text;
  std::string shorter = factors_.text(other);
  return shorter.size() < text.size() ? shorter : text;
}

// Terms that are the same but for parameters have one coefficient, and those whose coefficients are the same but for a
// factor are put together.
Polynomial SumArithmetic::with_coefficients(const Polynomial& sum) {
  std::map<Monomial, Polynomial> coefficients;
  for (const auto& [monomial, c] : sum) {
    const auto [parameters, others] = factors_.divided(monomial);
    coefficients[others][parameters] = c;
  }
  const bool is_coefficient = coefficients.size() == 1 && coefficients.begin()->first.empty();
  if (is_coefficient || coefficients.size() == sum.size()) return sum;
  std::map<Polynomial, Polynomial> alike;
  for (const auto& [others, coefficient] : coefficients) {
    const PolynomialContent of = content(coefficient, factors_);
    alike[of.primitive_part][product(others, of.monomial)] = of.number;
  }
  Polynomial result;
  for (const auto& [coefficient, others] : alike) {
    if (coefficient.size() == 1) {
      result.insert(others.begin(), others.end());
      continue;
    }
    const auto [monomial, c] = as_factor(others);
    result.emplace(normal(product(monomial, {{parentheses(coefficient), 1}})), c);
  }
  return result;
}

int SumArithmetic::parentheses(const Polynomial& sum) {
  return factors_.number({.text = "(" + text(sum) + ")", .sum = sum, .is_sum = true});
}

// Roots to an even power become what is under them.
Monomial SumArithmetic::normal(Monomial monomial) {
  for (std::size_t i = 0; i < monomial.size(); ++i) {
    const auto [factor, exponent] = monomial[i];
    const FactorTable::Factor& entry = factors_[factor];
    if (!entry.is_root || std::abs(exponent) < 2) continue;
    const int pairs = exponent / 2, left = exponent - 2 * pairs;
    const PolynomialContent under = content(entry.sum, factors_);
    if (under.number != 1.0 || !under.monomial.empty()) continue;  // as it stands
    monomial.erase(monomial.begin() + static_cast<std::ptrdiff_t>(i));
    if (left != 0) monomial = product(monomial, {{factor, left}});
    const Polynomial& sum = under.primitive_part;
    const Monomial inside = sum.size() == 1 ? sum.begin()->first : Monomial{{parentheses(sum), 1}};
    return normal(product(monomial, power(inside, pairs)));
  }
  return monomial;
}

// As one monomial and a number.
std::pair<Monomial, double> SumArithmetic::as_factor(const Polynomial& sum) {
  const Polynomial one = factored(sum);
  if (one.empty()) return {{}, 0.0};
  return *one.begin();
}

// A number times one sum is that sum.
Polynomial SumArithmetic::opened(const Polynomial& sum) const {
  if (sum.size() != 1) return sum;
  const auto& [monomial, c] = *sum.begin();
  if (monomial.size() != 1 || monomial[0].second != 1) return sum;
  const FactorTable::Factor& entry = factors_[monomial[0].first];
  return entry.is_sum ? scaled(entry.sum, c) : sum;
}

}  // namespace courant
