#include "courant/core/algebra/polynomial_relations.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <set>

namespace courant {
namespace {

constexpr std::size_t kMostInBasis = 40, kMostTerms = 60, kMostPairs = 300;

bool is_polynomial(const Polynomial& a) {
  return std::ranges::all_of(a, [](const auto& term) {
    return std::ranges::all_of(term.first, [](const auto& power) { return power.second > 0; });
  });
}

bool have_common_factors(const Monomial& a, const Monomial& b) {
  return std::ranges::any_of(a, [&](const auto& power) {
    return std::ranges::any_of(b, [&](const auto& q) { return q.first == power.first; });
  });
}

Monomial least_common_multiple(const Monomial& a, const Monomial& b) {
  return combined(a, b, [](int of_a, int of_b) { return std::max(of_a, of_b); });
}

}  // namespace

bool divides(const Monomial& a, const Monomial& b) {
  auto at = b.begin();
  for (const auto& [factor, power] : a) {
    while (at != b.end() && at->first < factor) ++at;
    if (at == b.end() || at->first != factor || at->second < power) return false;
  }
  return true;
}

int total_degree(const Monomial& monomial) {
  int sum = 0;
  for (const auto& [factor, power] : monomial) sum += power;
  return sum;
}

void add_term(Polynomial& polynomial, const Monomial& monomial, double c) {
  const auto [at, is_new] = polynomial.emplace(monomial, c);
  if (is_new) return;
  const double size = std::max(std::fabs(at->second), std::fabs(c));
  at->second += c;
  if (std::fabs(at->second) <= 1e-13 * size) polynomial.erase(at);
}

Monomial product(const Monomial& a, const Monomial& b, int sign) {
  return combined(a, b, [sign](int of_a, int of_b) { return of_a + sign * of_b; });
}

PolynomialRelations::PolynomialRelations(const std::vector<Polynomial>& relations,
                                         MonomialOrder order)
    : order_(order) {
  for (const Polynomial& relation : relations)
    if (is_polynomial(relation)) add(relation);
  complete();
}

int PolynomialRelations::eliminated_degree(const Monomial& monomial) const {
  int sum = 0;
  for (const auto& [factor, power] : monomial)
    if (factor >= order_.eliminated_from && factor < order_.eliminated_to) sum += power;
  return sum;
}

bool PolynomialRelations::comes_first(const Monomial& a, const Monomial& b) const {
  const int first_of_a = eliminated_degree(a), first_of_b = eliminated_degree(b);
  if (first_of_a != first_of_b) return first_of_a > first_of_b;
  return order_.backwards ? leads(a.rbegin(), a.rend(), b.rbegin(), b.rend(), std::greater<int>())
                          : leads(a, b, std::less<int>());
}

// Its remainder becomes an element; what that makes reducible is added once more. False where
// there is no remainder, or one that is too long.
bool PolynomialRelations::add(const Polynomial& polynomial) {
  std::deque<Polynomial> waiting = {polynomial};
  bool is_new = false;
  while (!waiting.empty() && basis_.size() < kMostInBasis) {
    const Polynomial next = remainder(waiting.front());
    waiting.pop_front();
    if (next.empty() || next.size() > kMostTerms) continue;
    Element element;
    double leading = 0.0;
    for (const auto& [monomial, c] : next)
      if (leading == 0.0 || comes_first(monomial, element.lead)) {
        element.lead = monomial;
        leading = c;
      }
    if (element.lead.empty()) {  // 1 = 0
      hold_nowhere_ = true;
      continue;
    }
    for (const auto& [monomial, c] : next)
      if (monomial != element.lead) element.rest.emplace(monomial, -c / leading);
    std::erase_if(basis_, [&](const Element& other) {
      if (!divides(element.lead, other.lead)) return false;
      Polynomial again = other.rest;
      for (auto& [monomial, c] : again) c = -c;
      again.emplace(other.lead, 1.0);
      waiting.push_back(std::move(again));
      return true;
    });
    basis_.push_back(std::move(element));
    is_new = true;
  }
  return is_new;
}

// Buchberger's algorithm: every pair of elements whose leads have a factor in common.
void PolynomialRelations::complete() {
  std::set<std::pair<Monomial, Monomial>> seen;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 1; i < basis_.size() && !changed; ++i)
      for (std::size_t j = 0; j < i && !changed; ++j) {
        const Element &a = basis_[i], &b = basis_[j];
        if (!have_common_factors(a.lead, b.lead) || !seen.emplace(a.lead, b.lead).second) continue;
        if (seen.size() > kMostPairs) return;
        const Monomial both = least_common_multiple(a.lead, b.lead);
        const Monomial of_a = product(both, a.lead, -1), of_b = product(both, b.lead, -1);
        Polynomial difference;
        for (const auto& [monomial, c] : a.rest) add_term(difference, product(of_a, monomial), c);
        for (const auto& [monomial, c] : b.rest) add_term(difference, product(of_b, monomial), -c);
        try {
          changed = add(difference);
        } catch (const std::length_error&) {
          return;
        }
      }
  }
}

std::vector<Polynomial> PolynomialRelations::basis() const {
  std::vector<Polynomial> all;
  for (const Element& element : basis_) {
    Polynomial& polynomial = all.emplace_back();
    for (const auto& [monomial, c] : element.rest) polynomial.emplace(monomial, -c);
    polynomial.emplace(element.lead, 1.0);
  }
  return all;
}

Polynomial PolynomialRelations::remainder(Polynomial polynomial) const {
  constexpr int kMostSteps = 2000;
  Polynomial result;
  for (int steps = 0; !polynomial.empty(); ++steps) {
    if (steps > kMostSteps)
      throw std::length_error(
          "PolynomialRelations::remainder: polynomial has a remainder of too "
          "many terms.");
    const auto [monomial, c] = *polynomial.begin();
    polynomial.erase(polynomial.begin());
    const auto element = std::ranges::find_if(
        basis_, [&m = monomial](const Element& entry) { return divides(entry.lead, m); });
    if (element == basis_.end()) {
      add_term(result, monomial, c);
      continue;
    }
    const Monomial multiplier = product(monomial, element->lead, -1);
    for (const auto& [term, coefficient] : element->rest)
      add_term(polynomial, product(multiplier, term), c * coefficient);
  }
  return result;
}

}  // namespace courant
