// Exact quotients of polynomials, also of those in sines and cosines.
#pragma once

#include <map>
#include <optional>

#include "courant/core/algebra/polynomial_relations.hpp"

namespace courant {

// Pairs of factors sin(a), cos(a).
using Circles = std::map<int, int>;

// sin² is 1 - cos²: polynomials that are equal have equal terms then.
Polynomial in_cosines(Polynomial polynomial, const Circles& circles);
// A term with its negative times cos² becomes one with sin²: a - a cos² is a sin².
Polynomial with_sines(Polynomial polynomial, const Circles& circles);

// That of highest degree; of a polynomial with terms.
const Polynomial::value_type& leading_term(const Polynomial& polynomial);

// a/b, if the division leaves nothing in a hundred steps. Both without negative powers, in cosines.
std::optional<Polynomial> quotient(Polynomial a, const Polynomial& b, const Circles& circles = {});

}  // namespace courant
