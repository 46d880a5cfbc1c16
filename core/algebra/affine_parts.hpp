// Affine parts of expressions.
#pragma once

#include "courant/core/expressions/expr.hpp"

namespace courant {

// The same expressions, in which all that is affine in the variables `varying` is written a + Σ b_i u_i:
//
//   (x + h (p - h u g/2)/m)² + …        (a + b u)² + …,   a = x + h p/m,  b = -h² g/(2 m)
//
// For many values of u with all else the same a and b are evaluated once (Function::hold).
ExprVector with_affine_parts(const ExprVector& expressions, const ExprVector& varying);

}  // namespace courant
