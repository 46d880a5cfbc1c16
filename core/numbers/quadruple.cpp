#include "courant/core/numbers/quadruple.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <limits>
#include <new>
#include <type_traits>

namespace courant {

using BinaryFloat = boost::multiprecision::cpp_bin_float_quad;

struct Quadruple::Number {
  BinaryFloat value;
};

Quadruple::Quadruple(const Number& number) {
  static_assert(sizeof(Number) <= sizeof(number_) && alignof(Number) <= alignof(Quadruple) &&
                std::is_trivially_destructible_v<Number>);
  ::new (number_.data()) Number(number);
}

const Quadruple::Number& Quadruple::number() const {
  return *std::launder(reinterpret_cast<const Number*>(number_.data()));
}

Quadruple::Quadruple(double number) : Quadruple(Number{BinaryFloat(number)}) {}

Quadruple::Quadruple(const Quadruple& other) : Quadruple(other.number()) {}

Quadruple& Quadruple::operator=(const Quadruple& other) {
  ::new (number_.data()) Number(Number(other.number()));
  return *this;
}

Quadruple::operator double() const { return static_cast<double>(number().value); }

Quadruple operator-(const Quadruple& a) { return Quadruple(Quadruple::Number{-a.number().value}); }

Quadruple operator+(const Quadruple& a, const Quadruple& b) {
  return Quadruple(Quadruple::Number{a.number().value + b.number().value});
}

Quadruple operator-(const Quadruple& a, const Quadruple& b) {
  return Quadruple(Quadruple::Number{a.number().value - b.number().value});
}

Quadruple operator*(const Quadruple& a, const Quadruple& b) {
  return Quadruple(Quadruple::Number{a.number().value * b.number().value});
}

Quadruple operator/(const Quadruple& a, const Quadruple& b) {
  return Quadruple(Quadruple::Number{a.number().value / b.number().value});
}

bool operator==(const Quadruple& a, const Quadruple& b) {
  return a.number().value == b.number().value;
}

Quadruple evaluate(Op op, const Quadruple& a) {
  const auto value = [op, &number = a.number().value]() -> BinaryFloat {
    switch (op) {
      case Op::sqrt:
        return sqrt(number);
      case Op::exp:
        return exp(number);
      case Op::log:
        return log(number);
      case Op::sin:
        return sin(number);
      case Op::cos:
        return cos(number);
      case Op::tan:
        return tan(number);
      case Op::asin:
        return asin(number);
      case Op::acos:
        return acos(number);
      case Op::atan:
        return atan(number);
      case Op::sinh:
        return sinh(number);
      case Op::cosh:
        return cosh(number);
      case Op::tanh:
        return tanh(number);
      default:
        return std::numeric_limits<BinaryFloat>::quiet_NaN();
    }
  };
  return Quadruple(Quadruple::Number{value()});
}

Quadruple pow(const Quadruple& a, const Quadruple& p) {
  return Quadruple(
      Quadruple::Number{boost::multiprecision::pow(a.number().value, p.number().value)});
}

Quadruple atan2(const Quadruple& y, const Quadruple& x) {
  return Quadruple(
      Quadruple::Number{boost::multiprecision::atan2(y.number().value, x.number().value)});
}

}  // namespace courant
