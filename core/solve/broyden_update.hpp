// A kept inverse that follows a Jacobian which changes.
#pragma once

#include "courant/core/expressions/expr.hpp"

namespace courant {

// Broyden's good update of the inverse A (n × n, column by column) of an earlier Jacobian of F, by two changes that
// simplified Newton made: s = A F(y), then r = A F(y - s).
//
//   A ← A + r (sᵀ W A) / (sᵀ W (s - r)),   so that A (F(y) - F(y - s)) = s
//
// It is the least change of A⁻¹, in units of W, that this asks for. `weighted`: W s for a diagonal W > 0; s, r: n
// numbers. False, with A as it was: r has more than half of s along s, so that A is of little use, or something is not
// finite. Sums are added up in two parts, even places and odd ones, so that programs in C give the same bits.
// Source: C. G. Broyden, Math. Comp. 19 (1965) 577-593; in this form P. Deuflhard, Newton Methods for Nonlinear
// Problems (2004), Section 2.1.4.
bool broyden_update(double* A, const double* s, const double* r, const double* weighted, Index n);

}  // namespace courant
