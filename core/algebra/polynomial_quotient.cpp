#include "courant/core/algebra/polynomial_quotient.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "courant/core/words/written_number.hpp"

namespace courant {
namespace {

// Products keep this order.
bool is_above(const Polynomial::value_type& a, const Polynomial::value_type& b) {
  return leads(a.first, b.first, std::less<int>());
}

const Monomial& lowest(const Polynomial& polynomial) {
  return std::ranges::max_element(polynomial, is_above)->first;
}

int power_of(int factor, const Monomial& monomial) {
  const auto found =
      std::ranges::find(monomial, factor, [](const auto& power) { return power.first; });
  return found == monomial.end() ? 0 : found->second;
}

bool replace_sine(Polynomial& polynomial, int sine, int cosine) {
  const auto found = std::ranges::find_if(
      polynomial, [&](const auto& term) { return power_of(sine, term.first) >= 2; });
  if (found == polynomial.end()) return false;
  const auto [monomial, c] = *found;
  const Monomial rest = product(monomial, {{sine, 2}}, -1);
  polynomial.erase(found);
  add_term(polynomial, rest, c);
  add_term(polynomial, product(rest, {{cosine, 2}}), -c);
  return true;
}

bool make_sine(Polynomial& polynomial, int sine, int cosine) {
  for (const auto& [monomial, c] : polynomial) {
    const Monomial rest = product(monomial, {{cosine, 2}}, -1);
    const auto other = polynomial.find(rest);
    if (power_of(cosine, monomial) < 2 || other == polynomial.end() ||
        !is_same_number(other->second, -c))
      continue;
    const double coefficient = other->second;
    polynomial.erase(other);
    polynomial.erase(Monomial(monomial));
    add_term(polynomial, product(rest, {{sine, 2}}), coefficient);
    return true;
  }
  return false;
}

}  // namespace

const Polynomial::value_type& leading_term(const Polynomial& polynomial) {
  return *std::ranges::min_element(polynomial, is_above);
}

Polynomial in_cosines(Polynomial polynomial, const Circles& circles) {
  for (const auto& [sine, cosine] : circles)
    while (replace_sine(polynomial, sine, cosine)) {
    }
  return polynomial;
}

Polynomial with_sines(Polynomial polynomial, const Circles& circles) {
  for (const auto& [sine, cosine] : circles)
    while (make_sine(polynomial, sine, cosine)) {
    }
  return polynomial;
}

std::optional<Polynomial> quotient(Polynomial a, const Polynomial& b, const Circles& circles) {
  constexpr int most_steps = 100;
  if (b.empty()) return std::nullopt;
  // The lowest term of a product is that of the lowest ones.
  if (circles.empty() && !a.empty() && !divides(lowest(b), lowest(a))) return std::nullopt;
  const auto& [lead, scale] = leading_term(b);
  Polynomial result;
  for (int steps = 0; !a.empty(); ++steps) {
    if (steps > most_steps) return std::nullopt;
    const auto [monomial, c] = leading_term(a);
    const Monomial multiplier = product(monomial, lead, -1);
    if (std::ranges::any_of(multiplier, [](const auto& power) { return power.second < 0; }))
      return std::nullopt;
    add_term(result, multiplier, c / scale);
    for (const auto& [term, coefficient] : b)
      add_term(a, product(term, multiplier), -coefficient * c / scale);
    a = in_cosines(std::move(a), circles);
  }
  return result;
}

}  // namespace courant
