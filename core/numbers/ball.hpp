// Ball: a real number between bounds that are proved.
#pragma once

#include <array>
#include <cstddef>

#include "courant/core/numbers/op.hpp"

namespace courant {

// A midpoint and a radius, in 512 bits. The result of an operation contains the results of the operation on all numbers
// of the balls that it is given: rounding only widens it. What is not defined on all of them is the whole line, which
// is not finite. So "does not contain 0" is a proof that a number is not 0; that a number is 0 no ball can prove,
// unless nothing in it was rounded (is_zero).
//
// The arithmetic is that of Arb. A build without it has the type, and is_available() says no.
class Ball {
 public:
  static bool is_available();

  Ball();               // 0
  Ball(double number);  // NOLINT: that number; the whole line for one that is not finite
  Ball(const Ball& other);
  Ball(Ball&& other) noexcept;
  Ball& operator=(Ball other) noexcept;
  ~Ball();

  // What a person means who writes this number (MeantNumber), as near as 512 bits are.
  static Ball written(double number);

  bool is_zero() const;    // exactly
  bool is_exact() const;   // of radius 0
  bool is_finite() const;  // bounded
  bool contains_zero() const;
  bool contains_inside(const Ball& other) const;  // with some room on both sides
  int sign() const;                               // of all its numbers; 0 if it contains 0

  explicit operator double() const;  // the midpoint, rounded
  double radius() const;             // rounded up
  double least_size() const;         // a lower bound of |a|
  Ball midpoint() const;             // exact
  // With all a + c, |c| ≤ 2^exponent max |other|.
  Ball widened_by(const Ball& other, int exponent) const;

  Ball& operator+=(const Ball& b) { return *this = *this + b; }
  Ball& operator-=(const Ball& b) { return *this = *this - b; }
  friend Ball operator-(const Ball& a);
  friend Ball operator+(const Ball& a, const Ball& b);
  friend Ball operator-(const Ball& a, const Ball& b);
  friend Ball operator*(const Ball& a, const Ball& b);
  friend Ball operator/(const Ball& a, const Ball& b);

  // op(a) for a unary operation of libm or sqrt, the whole line if it is none of them; a^p and the angle of (x, y).
  friend Ball evaluate(Op op, const Ball& a);
  friend Ball pow(const Ball& a, const Ball& p);
  friend Ball atan2(const Ball& y, const Ball& x);

 private:
  struct Access;  // to the numbers of Arb, whose header only the source has to read
  alignas(16) std::array<std::byte, 64> storage_;
};

Ball evaluate(Op op, const Ball& a);
Ball pow(const Ball& a, const Ball& p);
Ball atan2(const Ball& y, const Ball& x);

}  // namespace courant
