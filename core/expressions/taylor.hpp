// Arithmetic on truncated Taylor series, the algebra R[t]/(t^{K+1}).
#pragma once

#include <cstdint>

#include "courant/core/expressions/expr.hpp"
#include "courant/core/numbers/uncertain.hpp"

namespace courant {
class Ball;
class Digits;
class Quadruple;
}  // namespace courant

namespace courant::taylor {

// A series Σ_i a_i tⁱ, i = 0 … K, is an array of K+1 coefficients a_i = (dⁱa/dtⁱ)(0) / i!.

// out = op(a, b, c) to order K, in O(K²) operations (O(K³) for stumpff and arccos_factor); `out`
// must not overlap the operands. `scratch` has room for scratch_size(K) numbers. Conditions, signs
// and selections are decided by the leading coefficient (abs, min and max by the first one that
// decides). pow with a vanishing base and an exponent that isn't an integer, sqrt and log at 0 have
// no series: their coefficients come out not finite.
void apply(Op op, std::int32_t k, Index order, const double* a, const double* b, const double* c,
           double* out, double* scratch);
// The same with bounds of errors; the values are the same to the last bit.
void apply(Op op, std::int32_t k, Index order, const Uncertain* a, const Uncertain* b,
           const Uncertain* c, Uncertain* out, Uncertain* scratch);
// The same with 113 bits; NaN for arccos_factor, and for stumpff beyond 64.
void apply(Op op, std::int32_t k, Index order, const Quadruple* a, const Quadruple* b,
           const Quadruple* c, Quadruple* out, Quadruple* scratch);

// The same in two precisions; NaN for arccos_factor, and for stumpff beyond 400.
void apply(Op op, std::int32_t k, Index order, const Digits* a, const Digits* b, const Digits* c,
           Digits* out, Digits* scratch);
// The same in balls; the whole line for stumpff and arccos_factor, whose sums have no bound here of what is left out.
void apply(Op op, std::int32_t k, Index order, const Ball* a, const Ball* b, const Ball* c,
           Ball* out, Ball* scratch);

inline Index scratch_size(Index order) { return 3 * (order + 1); }

}  // namespace courant::taylor
