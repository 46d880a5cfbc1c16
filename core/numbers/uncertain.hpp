// Uncertain: a number with a bound of its error.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "courant/core/numbers/op.hpp"

namespace courant {

// The number that is meant is in [value - error, value + error].
//
// Running error analysis: each operation computes its value as it does on doubles, to the last bit,
// and beside it what the errors of the operands and its own rounding make of the error,
//
//   error(f(a, b)) = |∂f/∂a| error(a) + |∂f/∂b| error(b) + u |f|,   u = 2⁻⁵³ (2u for functions of libm),
//
// to first order, with the product of two errors where they multiply. A sum with an exact zero, a
// product with an exact 0 or ±1 have no rounding: what vanishes for structural reasons has error 0.
// The errors are taken as independent: where they cancel (x - x), the bound is too large and still
// true.
// Reference: Higham, Accuracy and Stability of Numerical Algorithms (2002), section 3.3.
struct Uncertain {
  double value = 0.0;
  double error = 0.0;

  Uncertain() = default;
  Uncertain(double exact) : value(exact) {}  // NOLINT: numbers are what formulas are written with
  Uncertain(double v, double e) : value(v), error(e) {}

  // A number that was typed, read or computed elsewhere: known to its last digit, unless it is a
  // small integer, or one divided by a power of two (20 bits suffice). Below 10⁻²⁹⁰ nothing is
  // known: quotients of such numbers leave the range of doubles.
  static Uncertain rounded(double v);

  // Whether the number is not zero for certain. False where nothing is known (error ∞ or NaN).
  bool is_nonzero() const { return std::fabs(value) > error; }
  bool is_exactly(double number) const { return error == 0.0 && value == number; }

  Uncertain& operator+=(const Uncertain& b) { return *this = *this + b; }
  Uncertain& operator-=(const Uncertain& b) { return *this = *this - b; }

  friend Uncertain operator-(const Uncertain& a) { return {-a.value, a.error}; }
  friend Uncertain operator+(const Uncertain& a, const Uncertain& b) {
    if (a.is_exactly(0.0)) return b;
    if (b.is_exactly(0.0)) return a;
    const double v = a.value + b.value;
    return {v, a.error + b.error + unit * std::fabs(v)};
  }
  friend Uncertain operator-(const Uncertain& a, const Uncertain& b) { return a + (-b); }
  friend Uncertain operator*(const Uncertain& a, const Uncertain& b) {
    if (a.is_exactly(0.0) || b.is_exactly(0.0)) return {a.value * b.value, 0.0};
    if (b.error == 0.0 && std::fabs(b.value) == 1.0) return {a.value * b.value, a.error};
    if (a.error == 0.0 && std::fabs(a.value) == 1.0) return {a.value * b.value, b.error};
    const double v = a.value * b.value;
    return {v, std::fabs(a.value) * b.error + std::fabs(b.value) * a.error + a.error * b.error +
                   unit * std::fabs(v)};
  }
  friend Uncertain operator/(const Uncertain& a, const Uncertain& b) {
    const double v = a.value / b.value;
    if (b.error == 0.0 && std::fabs(b.value) == 1.0) return {v, a.error};
    if (a.is_exactly(0.0) && b.is_nonzero()) return {v, 0.0};
    const double least = std::fabs(b.value) - b.error;
    if (!(least > 0.0)) return {v, std::numeric_limits<double>::infinity()};
    return {v, (a.error + std::fabs(v) * b.error) / least + unit * std::fabs(v)};
  }

  static constexpr double unit = 0.5 * std::numeric_limits<double>::epsilon();
};

// op(a) for a unary operation of libm or sqrt.
Uncertain evaluate(Op op, const Uncertain& a);
// a^p and the angle of (x, y).
Uncertain pow(const Uncertain& a, const Uncertain& p);
Uncertain atan2(const Uncertain& y, const Uncertain& x);

inline Uncertain Uncertain::rounded(double v) {
  constexpr double least = 1e-290;
  const double size = std::fabs(v);
  if (size > 0.0 && size < least) return {v, least};
  int exponent = 0;
  const double mantissa = std::ldexp(std::frexp(v, &exponent), 20);
  return {v, mantissa == std::floor(mantissa) ? 0.0 : unit * size};
}

}  // namespace courant
