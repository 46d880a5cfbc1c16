#include "courant/core/algebra/polynomial_reduction.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "courant/core/words/written_number.hpp"

namespace courant {

void PolynomialReduction::count(std::size_t terms) {
  if ((work_ += terms) > options_.most_work)
    throw std::length_error("PolynomialReduction: " + std::to_string(work_) +
                            " terms were added, expected at most " +
                            std::to_string(options_.most_work) + ".");
}

void PolynomialReduction::add(Polynomial& sum, const Monomial& monomial, double c) {
  count(1);
  const auto [at, is_new] = sum.emplace(monomial, c);
  if (is_new) return;
  const double size = std::max(std::fabs(at->second), std::fabs(c));
  at->second += c;
  if (std::fabs(at->second) <= 1e-14 * size) sum.erase(at);
}

Polynomial PolynomialReduction::plus(const Polynomial& a, const Polynomial& b, double sign) {
  Polynomial result = a;
  for (const auto& [monomial, c] : b) add(result, monomial, sign * c);
  return reduced(std::move(result));
}

void PolynomialReduction::assume(Polynomial relation) {
  std::set<int> factors;
  for (const auto& [monomial, c] : relation)
    if (!is_constant(monomial))
      for (const auto& [factor, exponent] : monomial)
        if (!parameters_.contains(factor)) factors.insert(factor);
  factors_.emplace_back(factors.begin(), factors.end());
  relations_.push_back(std::move(relation));
}

bool PolynomialReduction::is_constant(const Monomial& term) const {
  return std::ranges::all_of(term,
                             [&](const auto& power) { return parameters_.contains(power.first); });
}

// As divides(), but by parameters too.
bool PolynomialReduction::may_divide(const Monomial& a, const Monomial& b) const {
  return std::ranges::all_of(a, [&](const auto& of_a) {
    if (parameters_.contains(of_a.first)) return true;
    const auto of_b = std::ranges::find(b, of_a.first, &std::pair<int, int>::first);
    return of_b != b.end() && of_b->second >= of_a.second;
  });
}

// Whether a polynomial contains all of these.
bool PolynomialReduction::may_apply(const std::vector<int>& factors, const Polynomial& sum) {
  return std::ranges::all_of(factors, [&](int factor) {
    return std::ranges::any_of(sum, [&](const auto& term) {
      return std::ranges::any_of(term.first,
                                 [&](const auto& power) { return power.first == factor; });
    });
  });
}

Polynomial PolynomialReduction::reduced(Polynomial polynomial) {
  if (remainders_) polynomial = remainders_->remainder(std::move(polynomial));
  if (polynomial.size() > options_.most_terms)
    throw std::length_error("PolynomialReduction::reduced: the polynomial has " +
                            std::to_string(polynomial.size()) + " terms, expected at most " +
                            std::to_string(options_.most_terms) + ".");
  if (options_.in_cosines) polynomial = courant::in_cosines(std::move(polynomial), circles_);
  const std::size_t relations = remainders_ ? 0 : relations_.size();
  count(polynomial.size() * (1 + relations + circles_.size()));
  bool changed = true;
  while (changed) {
    changed = false;
    for (std::size_t i = 0; i < relations; ++i)
      if (may_apply(factors_[i], polynomial) && apply(relations_[i], polynomial)) changed = true;
    for (const auto& [sine, cosine] : circles_) {
      const Polynomial circle{{{{sine, 2}}, 1.0}, {{{cosine, 2}}, 1.0}, {Monomial{}, -1.0}};
      if (apply(circle, polynomial)) changed = true;
    }
  }
  return polynomial;
}

// Replaces one multiple of the terms of a relation by that of its constants.
bool PolynomialReduction::apply(const Polynomial& relation, Polynomial& sum) {
  const auto lead = std::find_if(relation.begin(), relation.end(),
                                 [&](const auto& term) { return !is_constant(term.first); });
  if (lead == relation.end()) return false;
  for (const auto& [monomial, c] : sum) {
    if (!may_divide(lead->first, monomial)) continue;
    const Monomial multiplier = product(monomial, lead->first, -1);
    const double scale = c / lead->second;
    bool all = true;
    for (const auto& [term, coefficient] : relation) {
      if (is_constant(term)) continue;
      const auto found = sum.find(product(multiplier, term));
      all = all && found != sum.end() && is_same_number(found->second, scale * coefficient);
    }
    if (!all) continue;
    for (const auto& [term, coefficient] : relation)
      if (!is_constant(term)) sum.erase(product(multiplier, term));
    for (const auto& [term, coefficient] : relation)
      if (is_constant(term)) add(sum, product(multiplier, term), -scale * coefficient);
    return true;
  }
  return false;
}

}  // namespace courant
