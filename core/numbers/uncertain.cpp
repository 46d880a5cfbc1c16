#include "courant/core/numbers/uncertain.hpp"

#include "courant/core/numbers/operation.hpp"

namespace courant {
namespace {

// f(a) with error |f'(a)| error(a), and two roundings of its value.
Uncertain with_slope(double f, double slope, const Uncertain& a) {
  const double from_a = a.error == 0.0 ? 0.0 : std::fabs(slope) * a.error;
  return {f, from_a + 2.0 * Uncertain::unit * std::fabs(f)};
}

double slope(Op op, double x, double f) {
  switch (op) {
    case Op::sqrt:
      return 0.5 / f;
    case Op::exp:
      return f;
    case Op::log:
      return 1.0 / x;
    case Op::sin:
      return std::cos(x);
    case Op::cos:
      return std::sin(x);
    case Op::sinh:
      return std::cosh(x);
    case Op::cosh:
      return std::sinh(x);
    case Op::tan:
      return 1.0 + f * f;
    case Op::tanh:
      return 1.0 - f * f;
    case Op::asin:
    case Op::acos:
      return 1.0 / std::sqrt((1.0 - x) * (1.0 + x));
    case Op::atan:
      return 1.0 / (1.0 + x * x);
    default:
      return std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace

Uncertain evaluate(Op op, const Uncertain& a) {
  const double f = evaluate(op, 0, a.value, 0.0, 0.0);
  // sin 0, √0, log 1, …
  if (a.error == 0.0 && f == 0.0) return 0.0;
  return with_slope(f, slope(op, a.value, f), a);
}

Uncertain pow(const Uncertain& a, const Uncertain& p) {
  const double f = std::pow(a.value, p.value);
  Uncertain result = with_slope(f, p.value * f / a.value, a);
  if (p.error > 0.0) result.error += std::fabs(f * std::log(a.value)) * p.error;
  return result;
}

Uncertain atan2(const Uncertain& y, const Uncertain& x) {
  const double f = std::atan2(y.value, x.value);
  if (y.is_exactly(0.0) && f == 0.0) return 0.0;
  const double square = x.value * x.value + y.value * y.value;
  return {f, (std::fabs(x.value) * y.error + std::fabs(y.value) * x.error) / square +
                 2.0 * Uncertain::unit * std::fabs(f)};
}

}  // namespace courant
