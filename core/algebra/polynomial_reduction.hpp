// Sums of polynomials, made shorter by relations between their factors.
#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "courant/core/algebra/polynomial_quotient.hpp"
#include "courant/core/algebra/polynomial_relations.hpp"

namespace courant {

// Polynomials where relations r = 0 and sin² + cos² = 1 hold. A multiple of all terms of a relation but
// the constant ones is replaced by that multiple of the constants, as long as there is one:
//
//   2 x² y + 2 y³ with x² + y² - 1 = 0:    2 y
//   2 x² y + 2 y³ with x² + y² - l² = 0:   2 l² y where l is a parameter
//
// Every polynomial has at most `most_terms` terms after it was reduced, and all of them together cost
// `most_work` terms that are added or looked at; what takes more throws std::length_error.
class PolynomialReduction {
 public:
  struct Options {
    std::size_t most_terms = 100;
    std::size_t most_work = 10'000;  // some milliseconds
    // Even powers of sines become cosines, which makes polynomials equal that are equal.
    bool in_cosines = false;
  };

  explicit PolynomialReduction(Options options) : options_(options) {}

  // From now on the relation holds.
  void assume(Polynomial relation);
  // What follows from all relations so far holds too: polynomials become their remainders
  // (PolynomialRelations), and no relation is applied by itself any more.
  void conclude(MonomialOrder order) { remainders_.emplace(relations_, order); }
  // The factors are the sine and the cosine of an angle.
  void add_circle(int sine, int cosine) { circles_.emplace(sine, cosine); }
  const Circles& circles() const { return circles_; }
  // The factor is a number with a name. To be said before the relations that it is in.
  void add_parameter(int factor) { parameters_.insert(factor); }

  // Adds c times a monomial; 1e-14 of what was added is round-off, and zero.
  void add(Polynomial& sum, const Monomial& monomial, double c);

  // a + sign b.
  Polynomial plus(const Polynomial& a, const Polynomial& b, double sign = 1.0);

  // What the relations make of it.
  Polynomial reduced(Polynomial polynomial);

 private:
  void count(std::size_t terms);
  bool is_constant(const Monomial& term) const;
  bool may_divide(const Monomial& a, const Monomial& b) const;
  static bool may_apply(const std::vector<int>& factors, const Polynomial& sum);
  bool apply(const Polynomial& relation, Polynomial& sum);

  Options options_;
  std::size_t work_ = 0;
  Circles circles_;
  std::set<int> parameters_;
  std::vector<Polynomial> relations_;
  std::vector<std::vector<int>> factors_;  // of each, without parameters, ascending
  std::optional<PolynomialRelations> remainders_;
};

}  // namespace courant
