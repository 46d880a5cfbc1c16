// What each operation of an expression graph means on numbers; shared by constant folding and the
// interpreter.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "courant/core/numbers/op.hpp"
#include "courant/core/numbers/special_functions.hpp"

namespace courant {

// aᵏ by repeated squaring, k of either sign. The run-time compiled code multiplies in the same
// order.
template <class Scalar>
Scalar integer_power(Scalar base, std::int32_t k) {
  auto exponent = static_cast<std::uint32_t>(k < 0 ? -static_cast<std::int64_t>(k) : k);
  Scalar result = 1.0;
  bool first = true;
  while (exponent != 0) {
    if ((exponent & 1U) != 0) {
      result = first ? base : result * base;
      first = false;
    }
    exponent >>= 1;
    if (exponent != 0) base = base * base;
  }
  return k < 0 ? Scalar(1.0) / result : result;
}

inline double evaluate(Op op, std::int32_t k, double a, double b, double c) {
  switch (op) {
    case Op::negate:
      return -a;
    case Op::add:
      return a + b;
    case Op::subtract:
      return a - b;
    case Op::multiply:
      return a * b;
    case Op::divide:
      return a / b;
    case Op::sqrt:
      return std::sqrt(a);
    case Op::exp:
      return std::exp(a);
    case Op::log:
      return std::log(a);
    case Op::sin:
      return std::sin(a);
    case Op::cos:
      return std::cos(a);
    case Op::tan:
      return std::tan(a);
    case Op::asin:
      return std::asin(a);
    case Op::acos:
      return std::acos(a);
    case Op::atan:
      return std::atan(a);
    case Op::sinh:
      return std::sinh(a);
    case Op::cosh:
      return std::cosh(a);
    case Op::tanh:
      return std::tanh(a);
    case Op::abs:
      return std::fabs(a);
    case Op::sign:
      return a > 0 ? 1.0 : (a < 0 ? -1.0 : a);
    case Op::power:
      return integer_power(a, k);
    case Op::pow:
      return std::pow(a, b);
    case Op::atan2:
      return std::atan2(a, b);
    case Op::min:
      return b < a ? b : a;
    case Op::max:
      return a < b ? b : a;
    case Op::less:
      return a < b ? 1.0 : 0.0;
    case Op::less_equal:
      return a <= b ? 1.0 : 0.0;
    case Op::equal:
      return a == b ? 1.0 : 0.0;
    case Op::logical_and:
      return a != 0 && b != 0 ? 1.0 : 0.0;
    case Op::logical_or:
      return a != 0 || b != 0 ? 1.0 : 0.0;
    case Op::logical_not:
      return a == 0 ? 1.0 : 0.0;
    case Op::select:
      return a != 0 ? b : c;
    case Op::stumpff:
      return stumpff(k, a);
    case Op::arccos_factor:
      return arccos_factor(k, a);
    case Op::constant:
    case Op::variable:
      break;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace courant
