// Polynomials modulo relations.
#pragma once

#include <boost/container/small_vector.hpp>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

namespace courant {

// Factors by their number, increasing, each with its power (not 0). Few have more than four.
using Monomial = boost::container::small_vector<std::pair<int, int>, 4>;
using Polynomial = std::map<Monomial, double>;  // no coefficient is 0

// For each factor of a or b the power that combine(its power in a, its power in b) says, 0 where it is in one of them
// only.
template <class Combine>
Monomial combined(const Monomial& a, const Monomial& b, const Combine& combine) {
  Monomial result;
  const auto add = [&](int factor, int power) {
    if (power != 0) result.emplace_back(factor, power);
  };
  auto i = a.begin();
  auto j = b.begin();
  while (i != a.end() || j != b.end()) {
    if (j == b.end() || (i != a.end() && i->first < j->first)) {
      add(i->first, combine(i->second, 0));
      ++i;
    } else if (i == a.end() || j->first < i->first) {
      add(j->first, combine(0, j->second));
      ++j;
    } else {
      add(i->first, combine(i->second, j->second));
      ++i, ++j;
    }
  }
  return result;
}

// a b, or a/b for sign = -1.
Monomial product(const Monomial& a, const Monomial& b, int sign = 1);

// Whether b has every factor of a, to no lower power.
bool divides(const Monomial& a, const Monomial& b);

// The sum of its powers.
int total_degree(const Monomial& monomial);

// Whether the monomial from a to a_end leads that from b to b_end: by degree, then by the factors, which both have in
// the order `before`, those with high powers first: x² before x y before y².
template <class Iterator, class Before>
bool leads(Iterator a, Iterator a_end, Iterator b, Iterator b_end, const Before& before) {
  const auto degree = [](Iterator i, Iterator end) {
    int sum = 0;
    for (; i != end; ++i) sum += i->second;
    return sum;
  };
  if (const int of_a = degree(a, a_end), of_b = degree(b, b_end); of_a != of_b) return of_a > of_b;
  for (; a != a_end && b != b_end; ++a, ++b) {
    if (a->first != b->first) return before(a->first, b->first);
    if (a->second != b->second) return a->second > b->second;
  }
  return a != a_end;
}
template <class Before>
bool leads(const Monomial& a, const Monomial& b, const Before& before) {
  return leads(a.begin(), a.end(), b.begin(), b.end(), before);
}

// Adds c times a monomial. Coefficients that cancel leave round-off: 1e-13 of what was added is zero.
void add_term(Polynomial& polynomial, const Monomial& monomial, double c);

// How monomials are ordered: see PolynomialRelations.
struct MonomialOrder {
  bool backwards = false;
  int eliminated_from = 0, eliminated_to = 0;  // these numbers, the last one not among them
};

// The ideal of polynomials r₁ … r_k, by a Gröbner basis of it: where all of them vanish, a
// polynomial equals its remainder, and remainders of equal polynomials are equal.
//
// Monomials are ordered by their degree in the factors that are to be eliminated, then by degree, then
// by the powers of the factors, those with the smallest number first or, `backwards`, last; the
// remainder has no multiple of a leading monomial. Factors
// with negative powers may stand in what is reduced, not in relations; relations that have some are
// left out. A basis that grows beyond 40 polynomials or 60 terms ends as it is: remainders are
// right then, but not the only ones.
//
// Reference: Cox, Little, O'Shea, Ideals, Varieties, and Algorithms, 2.7, Theorem 2 (Buchberger).
class PolynomialRelations {
 public:
  explicit PolynomialRelations(const std::vector<Polynomial>& relations, MonomialOrder order = {});

  // Throws std::length_error for polynomials that grow beyond some hundred terms.
  Polynomial remainder(Polynomial polynomial) const;

  // The basis, each polynomial with 1 as its leading coefficient.
  std::vector<Polynomial> basis() const;

  // Whether 1 is in the ideal, so that not all of the relations vanish anywhere.
  bool hold_nowhere() const { return hold_nowhere_; }

 private:
  struct Element {
    Monomial lead;
    Polynomial rest;  // lead = rest
  };

  bool comes_first(const Monomial& a, const Monomial& b) const;
  bool add(const Polynomial& polynomial);
  void complete();

  int eliminated_degree(const Monomial& monomial) const;

  MonomialOrder order_;
  std::vector<Element> basis_;
  bool hold_nowhere_ = false;
};

}  // namespace courant
