// DoubleDouble: numbers of 106 bits, as the sums of two doubles.
#pragma once

namespace courant {

// high + low with |low| ≤ half a unit of high's last place: some ten times as slow as double, and ten times as fast as
// Quadruple. What of a sum cancels takes its digits with it; no result is correctly rounded. The range is that of
// double: from 2⁻⁹⁶⁰ to 2⁹⁹⁰ nothing is lost.
//
// T. J. Dekker, A floating-point technique for extending the available precision, Numer. Math. 18 (1971).
struct DoubleDouble {
  double high = 0.0, low = 0.0;

  constexpr DoubleDouble() = default;
  // The number that the double is.
  constexpr DoubleDouble(double number) : high(number) {}  // NOLINT
  constexpr DoubleDouble(double of_high, double of_low) : high(of_high), low(of_low) {}

  constexpr bool is_zero() const { return high == 0.0; }

  // a + b for |a| ≥ |b|, and for any two.
  static constexpr DoubleDouble ordered_sum(double a, double b) {
    const double sum = a + b;
    return {sum, b - (sum - a)};
  }
  static constexpr DoubleDouble sum(double a, double b) {
    const double sum = a + b, part = sum - a;
    return {sum, (a - (sum - part)) + (b - part)};
  }
  static constexpr DoubleDouble product(double a, double b) {
    const DoubleDouble x = halves(a), y = halves(b);
    const double product = a * b;
    return {product,
            ((x.high * y.high - product) + x.high * y.low + x.low * y.high) + x.low * y.low};
  }

  DoubleDouble& operator+=(const DoubleDouble& b) { return *this = *this + b; }
  DoubleDouble& operator-=(const DoubleDouble& b) { return *this = *this - b; }
  friend constexpr DoubleDouble operator-(const DoubleDouble& a) { return {-a.high, -a.low}; }
  friend constexpr DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble sum = DoubleDouble::sum(a.high, b.high);
    return ordered_sum(sum.high, sum.low + a.low + b.low);
  }
  friend constexpr DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) {
    return a + -b;
  }
  friend constexpr DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble product = DoubleDouble::product(a.high, b.high);
    return ordered_sum(product.high, product.low + a.high * b.low + a.low * b.high);
  }
  friend constexpr DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
    const double quotient = a.high / b.high;
    const DoubleDouble rest = a - b * quotient;
    return ordered_sum(quotient, rest.high / b.high);
  }

 private:
  // With 26 bits each, so that products of them are exact.
  static constexpr DoubleDouble halves(double a) {
    constexpr double splitter = 134217729.0;  // 2²⁷ + 1
    const double scaled = splitter * a, high = scaled - (scaled - a);
    return {high, a - high};
  }
};

}  // namespace courant
