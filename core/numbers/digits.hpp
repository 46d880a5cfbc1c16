// Digits: a number that knows whether it is zero.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "courant/core/numbers/op.hpp"

namespace courant {

// A real number in two precisions, of 128 and of 256 bits. Every operation is carried out in both.
//
//   a is zero   if and only if   |a with 256 bits| ≤ 2⁻⁶⁴ |a with 128 bits|
//
// What is zero but for rounding shrinks with the unit of rounding, here by some 2⁻¹²⁸; what is not zero stays
// what it is. So no scale, no bound and no unit decides. Wrong is a zero whose coarse part is by chance 2⁶⁴ times
// smaller than its rounding; and what is below some 2⁻¹²⁸ of the numbers that cancelled in it counts as zero
// where nothing is left of the coarse part.
//
// Both parts must come from equal formulas of equal data. Exponents have 32 bits: products of many units do not leave
// the range.
class Digits {
 public:
  Digits();  // 0
  // The number that the double is, to the last bit.
  Digits(double number);  // NOLINT: numbers are what formulas are written with
  Digits(const Digits& other);
  Digits& operator=(const Digits& other);

  // What a person means who writes this number (MeantNumber). Not finite numbers as they are.
  static Digits written(double number);

  bool is_zero() const { return is_zero_; }  // exactly, in both
  bool shrinks() const;                      // zero by the rule above
  bool is_finite() const;
  // *this, or 0 where that shrinks.
  Digits& settle();

  explicit operator double() const;  // the fine part, rounded
  double coarse() const;             // the coarse part, rounded
  // Numbers, the largest first, whose sum is the fine part, but for what no double is small enough for.
  std::array<double, 5> terms() const;
  // The exponent e with 2^(e-1) ≤ |a| < 2^e of the fine part; a is not zero.
  std::int64_t exponent() const;
  int sign() const;  // of the fine part: -1, 0, 1

  Digits times_power_of_two(std::int64_t exponent) const;
  // coarse - a and fine - b: a step of an iteration that each precision makes by itself.
  Digits corrected(double a, double b) const;
  // With both parts from the fine one: where both precisions begin a search at one place.
  Digits from_fine() const;
  // With the coarse part 0: a correction of the fine part alone.
  Digits fine_alone() const;

  Digits& operator+=(const Digits& b) { return *this = *this + b; }
  Digits& operator-=(const Digits& b) { return *this = *this - b; }
  friend Digits operator-(const Digits& a);
  friend Digits operator+(const Digits& a, const Digits& b);
  friend Digits operator-(const Digits& a, const Digits& b);
  friend Digits operator*(const Digits& a, const Digits& b);
  friend Digits operator/(const Digits& a, const Digits& b);
  friend bool operator==(const Digits& a, const Digits& b);  // in both
  // Whether |a| < |b| in the fine parts: what pivots are chosen by.
  friend bool is_smaller(const Digits& a, const Digits& b);

  // row_j - factor · pivot_j for each j < count, settled.
  friend void subtract_multiple(Digits* row, const Digits& factor, const Digits* pivot,
                                std::size_t count);

  // op(a) for a unary operation of libm or sqrt, NaN where it is not defined or is none of them;
  // a^p and the angle of (x, y).
  friend Digits evaluate(Op op, const Digits& a);
  friend Digits pow(const Digits& a, const Digits& p);
  friend Digits atan2(const Digits& y, const Digits& x);

 private:
  struct Pair;  // of numbers of Boost.Multiprecision, whose headers only the source has to read
  explicit Digits(const Pair& pair);
  const Pair& pair() const;
  Pair& pair();

  alignas(16) std::array<std::byte, 96> numbers_;
  bool is_zero_ = true;
};

Digits evaluate(Op op, const Digits& a);
Digits pow(const Digits& a, const Digits& p);
Digits atan2(const Digits& y, const Digits& x);
bool is_smaller(const Digits& a, const Digits& b);
void subtract_multiple(Digits* row, const Digits& factor, const Digits* pivot, std::size_t count);

}  // namespace courant
