// Quadruple: a number of 113 bits, for what double cannot tell from round-off.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "courant/core/expr.hpp"

namespace courant {

// An IEEE binary128 number, in software: some hundred times slower than double. Doubles are such numbers as they
// stand; 0.1 is the double next to a tenth.
class Quadruple {
 public:
  Quadruple() = default;
  Quadruple(double number)
      : number_(number) {}  // NOLINT: numbers are what formulas are written with

  explicit operator double() const { return static_cast<double>(number_); }

  Quadruple& operator+=(const Quadruple& b) { return *this = *this + b; }
  Quadruple& operator-=(const Quadruple& b) { return *this = *this - b; }
  friend Quadruple operator-(const Quadruple& a) { return Quadruple(-a.number_); }
  friend Quadruple operator+(const Quadruple& a, const Quadruple& b) {
    return Quadruple(a.number_ + b.number_);
  }
  friend Quadruple operator-(const Quadruple& a, const Quadruple& b) {
    return Quadruple(a.number_ - b.number_);
  }
  friend Quadruple operator*(const Quadruple& a, const Quadruple& b) {
    return Quadruple(a.number_ * b.number_);
  }
  friend Quadruple operator/(const Quadruple& a, const Quadruple& b) {
    return Quadruple(a.number_ / b.number_);
  }
  friend bool operator==(const Quadruple& a, const Quadruple& b) { return a.number_ == b.number_; }

  // op(a) for a unary operation of libm or sqrt; NaN where it is not defined, or is none of them.
  friend Quadruple evaluate(Op op, const Quadruple& a);
  // a^p and the angle of (x, y).
  friend Quadruple pow(const Quadruple& a, const Quadruple& p);
  friend Quadruple atan2(const Quadruple& y, const Quadruple& x);

  // By how much its unit of rounding is smaller than that of double: 2⁻⁵³ / 2⁻¹¹³.
  static constexpr double finer = 1152921504606846976.0;

 private:
  using Number = boost::multiprecision::cpp_bin_float_quad;
  explicit Quadruple(const Number& number) : number_(number) {}

  Number number_ = 0;
};

Quadruple evaluate(Op op, const Quadruple& a);
Quadruple pow(const Quadruple& a, const Quadruple& p);
Quadruple atan2(const Quadruple& y, const Quadruple& x);

}  // namespace courant
