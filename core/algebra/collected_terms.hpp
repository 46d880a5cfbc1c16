// Sums in which equal terms are put together.
#pragma once

#include "courant/core/expressions/expr.hpp"

namespace courant {

// The same expressions with fewer operations, where sums with numbers for coefficients repeat terms:
//
//   (p + d - p)/h             d/h
//   (x/2 - (p + y)/2)/(1/2)   x - p - y       where a term of this sum repeats
//   q - x for q = x + d/2     d/2             though q is needed elsewhere
//
// A sum is written anew only if terms of it meet and by itself it takes no more operations than before; every
// other operation stays as it is, and so do its bits. A sum in parentheses none of whose terms meets another one stays
// too, since its terms may cancel: 10⁻¹⁴ (exp(v) - 1). Sums that are needed in several places are taken
// apart only for terms that meet. A coefficient that is round-off of what it was added up from is zero.
// Takes a time that is linear in the size of the expressions.
ExprVector collected(const ExprVector& expressions);

// The same for many values of the variables `varying`. What the others determine is evaluated once, so only operations
// with what varies count:
//
//   h ((y/2)/(-4))             (-h/8) y                 for d and y that vary
//   d/h + y - (x - d)/h        (2/h) (d - x/2) + y
//
// Powers of two in a row, with one known factor, become one product with the same bits. Terms meet that have the same
// known factor, if their coefficients are powers of two; of such a sum the variables that are known are added up first.
ExprVector collected(const ExprVector& expressions, const ExprVector& varying);

}  // namespace courant
