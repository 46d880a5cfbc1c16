// Products of polynomials, taken apart.
#pragma once

#include <vector>

#include "courant/core/algebra/polynomial_relations.hpp"

namespace courant {

// The real factors of a polynomial that are no numbers, each once and with 1 as its leading coefficient, monomials
// first:
//
//   x y² - x        x, y - 1, y + 1
//   x² - 2 y²       x - √2 y, x + √2 y
//   x² + y²         x² + y²
//
// A factor is irreducible over the real numbers where it is of degree 1 or 2 in one of its variables. Others may be
// products of factors of which none has degree 1 in a variable by which it was looked for: these are not found. Powers
// are ≥ 0; 0 has no factors.
std::vector<Polynomial> polynomial_factors(const Polynomial& a);

// Whether it is seen that a polynomial of several terms has one sign: all powers are even and all coefficients have the
// same sign, so that it is 0 only where all of its terms are.
bool has_one_sign(const Polynomial& a);

}  // namespace courant
