// Sums in which equal terms are put together.
#pragma once

#include "courant/core/expr.hpp"

namespace courant {

// The same expressions with fewer operations, where sums with numbers for coefficients repeat terms:
//
//   (p + d - p)/h             d/h
//   (x/2 - (p + y)/2)/(1/2)   x - p - y       where a term of this sum repeats
//   q - x for q = x + d/2     d/2             though q is needed elsewhere
//
// A sum is written anew only if terms of it meet and by itself it takes no more operations than before; every
// other operation stays as it is, and so do its bits. Sums that are needed in several places are taken
// apart only for terms that meet. A coefficient that is round-off of what it was added up from is zero.
// Takes a time that is linear in the size of the expressions.
ExprVector collected(const ExprVector& expressions);

// The same for many values of the variables `varying`; what the others determine is evaluated once, and only operations
// with what varies count. So terms meet that have the same known factor, and powers of two in a row with such a factor become one with it:
//
//   d/h + y - (x - d)/h        (2/h) (d - x/2) + y      for d and y that vary
//   h ((y/2)/(-4))             (-h/8) y
//
// Sums of terms with one factor stay in their parentheses, as terms may cancel there.
ExprVector collected(const ExprVector& expressions, const ExprVector& varying);

}  // namespace courant
