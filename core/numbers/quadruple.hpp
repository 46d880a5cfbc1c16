// Quadruple: a number of 113 bits, for what double cannot tell from round-off.
#pragma once

#include <array>
#include <cstddef>

#include "courant/core/numbers/op.hpp"

namespace courant {

// An IEEE binary128 number, in software: some hundred times slower than double. Doubles are such numbers as they
// stand; 0.1 is the double next to a tenth.
class Quadruple {
 public:
  Quadruple() : Quadruple(0.0) {}
  Quadruple(double number);  // NOLINT: numbers are what formulas are written with
  Quadruple(const Quadruple& other);
  Quadruple& operator=(const Quadruple& other);

  explicit operator double() const;

  Quadruple& operator+=(const Quadruple& b) { return *this = *this + b; }
  Quadruple& operator-=(const Quadruple& b) { return *this = *this - b; }
  friend Quadruple operator-(const Quadruple& a);
  friend Quadruple operator+(const Quadruple& a, const Quadruple& b);
  friend Quadruple operator-(const Quadruple& a, const Quadruple& b);
  friend Quadruple operator*(const Quadruple& a, const Quadruple& b);
  friend Quadruple operator/(const Quadruple& a, const Quadruple& b);
  friend bool operator==(const Quadruple& a, const Quadruple& b);

  // op(a) for a unary operation of libm or sqrt; NaN where it is not defined, or is none of them.
  friend Quadruple evaluate(Op op, const Quadruple& a);
  // a^p and the angle of (x, y).
  friend Quadruple pow(const Quadruple& a, const Quadruple& p);
  friend Quadruple atan2(const Quadruple& y, const Quadruple& x);

  // By how much its unit of rounding is smaller than that of double: 2⁻⁵³ / 2⁻¹¹³.
  static constexpr double finer = 1152921504606846976.0;

 private:
  struct Number;  // that of Boost.Multiprecision, whose headers only the source has to read
  explicit Quadruple(const Number& number);
  const Number& number() const;

  alignas(16) std::array<std::byte, 32> number_;
};

Quadruple evaluate(Op op, const Quadruple& a);
Quadruple pow(const Quadruple& a, const Quadruple& p);
Quadruple atan2(const Quadruple& y, const Quadruple& x);

}  // namespace courant
