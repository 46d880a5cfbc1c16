#include "courant/core/language/known_number.hpp"

#include <cmath>

#include "courant/core/numbers/operation.hpp"

namespace courant::formula {
namespace {

constexpr double kMostExact = 0x1p53;

bool is_known_integer(const KnownNumber& a) {
  return a.value == std::floor(a.value) && std::fabs(a.value) < kMostExact && !a.digits;
}

Digits digits_of(const KnownNumber& a) { return a.digits ? *a.digits : Digits::written(a.value); }

std::optional<KnownNumber> as_known_number(Digits number) {
  number.settle();
  if (!number.is_finite()) return std::nullopt;
  KnownNumber result{static_cast<double>(number), {}};
  if (!(number - Digits::written(result.value)).shrinks())
    result.digits = std::make_shared<const Digits>(number);
  return result;
}

}  // namespace

std::optional<KnownNumber> known(Op op, const KnownNumber& a) {
  if (!std::isfinite(a.value)) return std::nullopt;
  return as_known_number(op == Op::negate ? -digits_of(a) : evaluate(op, digits_of(a)));
}

std::optional<KnownNumber> known(Op op, const KnownNumber& a, const KnownNumber& b) {
  const double x = a.value, y = b.value;
  if (!std::isfinite(x) || !std::isfinite(y)) return std::nullopt;
  // What doubles do without rounding.
  if (is_known_integer(a) && is_known_integer(b) && op != Op::divide && op != Op::pow)
    if (const double result = evaluate(op, 0, x, y, 0.0); std::fabs(result) < kMostExact)
      return KnownNumber{result, {}};
  switch (op) {
    case Op::add:
      return as_known_number(digits_of(a) + digits_of(b));
    case Op::subtract:
      return as_known_number(digits_of(a) - digits_of(b));
    case Op::multiply:
      return as_known_number(digits_of(a) * digits_of(b));
    case Op::divide:
      if (y == 0.0) return std::nullopt;
      return as_known_number(digits_of(a) / digits_of(b));
    case Op::pow:
      if (x == 0.0 || (x < 0.0 && y != std::floor(y))) return std::nullopt;
      if (y == std::floor(y) && std::fabs(y) <= 64.0)
        return as_known_number(integer_power(digits_of(a), static_cast<std::int32_t>(y)));
      if (x < 0.0) return std::nullopt;
      return as_known_number(pow(digits_of(a), digits_of(b)));
    default:
      return std::nullopt;
  }
}

}  // namespace courant::formula
