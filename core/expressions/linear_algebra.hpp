// Linear algebra on expressions.
#pragma once

#include "courant/core/expressions/expr.hpp"

namespace courant {

// A⁻¹ b for a square A (n × n) and b (n × m), by elimination without pivoting: an expression cannot
// choose a pivot, so every leading minor has to stay away from zero where the result is used (A
// near the identity, symmetric definite, triangular …). Throws std::invalid_argument if the sizes
// do not fit, std::domain_error if a pivot is identically zero.
ExprMatrix solve(ExprMatrix A, ExprMatrix b);

// An x with A x = b for a symmetric semidefinite A (n × n) that has a solution, b n × m: rows of x are 0 where a pivot
// of the elimination is identically zero. What A maps to zero otherwise (a pivot that vanishes at some points) is
// divided by.
// Throws std::invalid_argument if the sizes do not fit.
ExprMatrix solve_semidefinite(ExprMatrix A, ExprMatrix b);

// det A and the adjugate, A adj A = det A, of a square A (n × n, n ≤ 16, else std::invalid_argument):
// polynomials, from all minors, of which there are as many as the binomial coefficient of 2n over n. For
// small matrices whose leading minors may vanish, such as rotations.
Expr determinant(const ExprMatrix& A);
ExprMatrix adjugate(const ExprMatrix& A);

}  // namespace courant
