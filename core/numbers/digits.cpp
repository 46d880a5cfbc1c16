#include "courant/core/numbers/digits.hpp"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <new>
#include <type_traits>

#include "courant/core/numbers/long_arithmetic.hpp"
#include "courant/core/numbers/meant_number.hpp"

namespace courant {
namespace {

namespace multiprecision = boost::multiprecision;
using Coarse = LongNumber<128>;
using Fine = LongNumber<256>;

constexpr int kShrunkExponent = -64;

template <class Number>
Number unary_operation(Op op, const Number& a) {
  switch (op) {
    case Op::sqrt:
      return a < 0 ? std::numeric_limits<Number>::quiet_NaN() : Number(sqrt(a));
    case Op::exp:
      return exp(a);
    case Op::log:
      return a <= 0 ? std::numeric_limits<Number>::quiet_NaN() : Number(log(a));
    case Op::sin:
      return sin(a);
    case Op::cos:
      return cos(a);
    case Op::tan:
      return tan(a);
    case Op::asin:
      return abs(a) > 1 ? std::numeric_limits<Number>::quiet_NaN() : Number(asin(a));
    case Op::acos:
      return abs(a) > 1 ? std::numeric_limits<Number>::quiet_NaN() : Number(acos(a));
    case Op::atan:
      return atan(a);
    case Op::sinh:
      return sinh(a);
    case Op::cosh:
      return cosh(a);
    case Op::tanh:
      return tanh(a);
    default:
      return std::numeric_limits<Number>::quiet_NaN();
  }
}

template <class Number>
Number number_that_reads(const MeantNumber& written) {
  Number value;
  if (const auto& fraction = written.fraction) {
    value = fraction->value<Number>(acos(Number(-1)));
  } else {
    value = Number(written.digits);
    const Number power = pow(Number(10), std::abs(written.exponent));
    if (written.exponent < 0)
      value /= power;
    else
      value *= power;
  }
  return written.is_negative ? Number(-value) : value;
}

}  // namespace

struct Digits::Pair {
  Coarse coarse;
  Fine fine;
};

Digits::Digits(const Pair& pair) : is_zero_(pair.fine.is_zero()) {
  static_assert(sizeof(Pair) <= sizeof(numbers_) && alignof(Pair) <= alignof(Digits) &&
                std::is_trivially_destructible_v<Pair>);
  if (is_zero_)  // what only the coarse part has left is its rounding
    ::new (numbers_.data()) Pair{};
  else
    ::new (numbers_.data()) Pair(pair);
}

const Digits::Pair& Digits::pair() const {
  return *std::launder(reinterpret_cast<const Pair*>(numbers_.data()));
}

Digits::Pair& Digits::pair() { return *std::launder(reinterpret_cast<Pair*>(numbers_.data())); }

Digits::Digits() { ::new (numbers_.data()) Pair{}; }

Digits::Digits(double number) : Digits(Pair{Coarse(number), Fine(number)}) {}

Digits::Digits(const Digits& other) : Digits(other.pair()) {}

Digits& Digits::operator=(const Digits& other) {
  if (this != &other) pair() = other.pair();
  is_zero_ = other.is_zero_;
  return *this;
}

Digits Digits::written(double number) {
  if (!std::isfinite(number) || number == 0.0) return number;
  // Its decimal says no other number: to read it would take as long as a hundred sums.
  constexpr double grid = 1024.0, most = 1048576.0;
  if (std::fabs(number) <= most && number * grid == std::floor(number * grid)) return number;
  const MeantNumber written = meant_number(number);
  return Digits(Pair{number_that_reads<Coarse>(written), number_that_reads<Fine>(written)});
}

bool Digits::shrinks() const {
  if (is_zero_) return true;
  const auto& [coarse, fine] = pair();
  if (coarse.is_zero() || fine.is_zero()) return true;
  // |fine| ≤ 2⁻⁶⁴ |coarse| by exponents, which are enough.
  if (!multiprecision::isfinite(coarse) || !multiprecision::isfinite(fine)) return false;
  return static_cast<std::int64_t>(fine.backend().exponent()) -
             static_cast<std::int64_t>(coarse.backend().exponent()) <=
         kShrunkExponent;
}

bool Digits::is_finite() const {
  return is_zero_ ||
         (multiprecision::isfinite(pair().coarse) && multiprecision::isfinite(pair().fine));
}

Digits& Digits::settle() {
  if (!is_zero_ && shrinks()) *this = Digits();
  return *this;
}

Digits::operator double() const { return static_cast<double>(pair().fine); }

double Digits::coarse() const { return static_cast<double>(pair().coarse); }

std::array<double, 5> Digits::terms() const {
  std::array<double, 5> result{};
  Fine rest = pair().fine;
  for (double& term : result) {
    term = static_cast<double>(rest);
    if (!std::isfinite(term)) break;
    rest -= term;
  }
  return result;
}

std::int64_t Digits::exponent() const { return std::int64_t{pair().fine.backend().exponent()} + 1; }

int Digits::sign() const { return is_zero_ ? 0 : pair().fine.sign(); }

Digits Digits::times_power_of_two(std::int64_t exponent) const {
  if (is_zero_) return *this;
  const auto e = static_cast<int>(exponent);
  return Digits(Pair{ldexp(pair().coarse, e), ldexp(pair().fine, e)});
}

Digits Digits::corrected(double a, double b) const {
  return Digits(Pair{pair().coarse - a, pair().fine - b});
}

Digits Digits::from_fine() const { return Digits(Pair{Coarse(pair().fine), pair().fine}); }

Digits Digits::fine_alone() const { return Digits(Pair{Coarse(0), pair().fine}); }

Digits operator-(const Digits& a) { return Digits(Digits::Pair{-a.pair().coarse, -a.pair().fine}); }

Digits operator+(const Digits& a, const Digits& b) {
  if (a.is_zero_) return b;
  if (b.is_zero_) return a;
  return Digits(Digits::Pair{sum<128>(a.pair().coarse, b.pair().coarse),
                             sum<256>(a.pair().fine, b.pair().fine)});
}

Digits operator-(const Digits& a, const Digits& b) {
  if (b.is_zero_) return a;
  return Digits(Digits::Pair{difference<128>(a.pair().coarse, b.pair().coarse),
                             difference<256>(a.pair().fine, b.pair().fine)});
}

Digits operator*(const Digits& a, const Digits& b) {
  if (a.is_zero_) return b.is_finite() ? a : b;
  if (b.is_zero_) return a.is_finite() ? b : a;
  return Digits(Digits::Pair{product<128>(a.pair().coarse, b.pair().coarse),
                             product<256>(a.pair().fine, b.pair().fine)});
}

Digits operator/(const Digits& a, const Digits& b) {
  if (b.is_zero_) return std::numeric_limits<double>::quiet_NaN();
  return Digits(Digits::Pair{a.pair().coarse / b.pair().coarse, a.pair().fine / b.pair().fine});
}

bool operator==(const Digits& a, const Digits& b) {
  return a.pair().coarse == b.pair().coarse && a.pair().fine == b.pair().fine;
}

bool is_smaller(const Digits& a, const Digits& b) {
  return abs(a.pair().fine) < abs(b.pair().fine);
}

void subtract_multiple(Digits* row, const Digits& factor, const Digits* pivot, std::size_t count) {
  for (std::size_t j = 0; j < count; ++j) {
    if (pivot[j].is_zero_) continue;
    Digits::Pair& target = row[j].pair();
    const Digits::Pair& other = pivot[j].pair();
    target.coarse =
        difference<128>(target.coarse, product<128>(factor.pair().coarse, other.coarse));
    target.fine = difference<256>(target.fine, product<256>(factor.pair().fine, other.fine));
    row[j].is_zero_ = false;
    row[j].settle();
  }
}

Digits evaluate(Op op, const Digits& a) {
  try {
    return Digits(
        Digits::Pair{unary_operation(op, a.pair().coarse), unary_operation(op, a.pair().fine)});
  } catch (const std::exception&) {  // Boost's word for what is out of range
    return std::numeric_limits<double>::quiet_NaN();
  }
}

Digits pow(const Digits& a, const Digits& p) {
  try {
    return Digits(Digits::Pair{multiprecision::pow(a.pair().coarse, p.pair().coarse),
                               multiprecision::pow(a.pair().fine, p.pair().fine)});
  } catch (const std::exception&) {
    return std::numeric_limits<double>::quiet_NaN();
  }
}

Digits atan2(const Digits& y, const Digits& x) {
  return Digits(Digits::Pair{multiprecision::atan2(y.pair().coarse, x.pair().coarse),
                             multiprecision::atan2(y.pair().fine, x.pair().fine)});
}

}  // namespace courant
