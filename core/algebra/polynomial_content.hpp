// What divides all terms of a polynomial.
#pragma once

#include "courant/core/algebra/factor_table.hpp"
#include "courant/core/algebra/polynomial_relations.hpp"

namespace courant {

// A polynomial as number · monomial · primitive part.
struct PolynomialContent {
  // The largest monomial that can be taken out of all terms. Where some have a factor to a negative
  // power, the most negative one is taken out: the primitive part has no denominators.
  Monomial monomial = {};
  // The coefficient of the leading term, the smallest or the largest one, with the sign of the leading
  // one: that which leaves the shortest numbers in the primitive part.
  double number = 1.0;
  Polynomial primitive_part = {};
};

// The content of 0 is 1, its primitive part 0. Terms lead in the order in which the table writes them.
PolynomialContent content(const Polynomial& polynomial, const FactorTable& factors);

}  // namespace courant
