// Differences of a function between two points, without cancellation.
#pragma once

#include "courant/core/expressions/expr.hpp"

namespace courant {

// (y(x + s d) - y(x)) / s (size m) at the variables x for y: Rⁿ → Rᵐ, a direction d (n) and a step s,
// which may be any expressions: an expression that is smooth in s, and at s = 0 is the derivative
// of y along d. So
//
//   y(x + d) - y(x) = divided_difference(y, x, d, 1)
//
// is right to a few units of round-off of its terms however small d is. Each operation passes on the
// difference of its operands:
//
//   a b            Δa mean(b) + mean(a) Δb              sin a    2 cos(mean a) sin(Δa/2)
//   a / b          (Δa mean(b) - mean(a) Δb) / (b₀ b₁)  exp a    2 exp(mean a) sinh(Δa/2)
//   sqrt a         Δa / (√a₀ + √a₁)                     log a    2 arsinh(Δa / (2 √(a₀ a₁)))
//
// Operations that choose (select, min, max, abs) have the difference of the operand that they choose
// at both ends, and the plain one where the ends choose differently. Throws std::invalid_argument as
// tangent does.
ExprVector divided_difference(const ExprVector& y, const ExprVector& x, const ExprVector& direction,
                              const Expr& step);

}  // namespace courant
