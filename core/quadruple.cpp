#include "courant/core/quadruple.hpp"

namespace courant {

Quadruple evaluate(Op op, const Quadruple& a) {
  const auto value = [&]() -> Quadruple::Number {
    switch (op) {
      case Op::sqrt:
        return sqrt(a.number_);
      case Op::exp:
        return exp(a.number_);
      case Op::log:
        return log(a.number_);
      case Op::sin:
        return sin(a.number_);
      case Op::cos:
        return cos(a.number_);
      case Op::tan:
        return tan(a.number_);
      case Op::asin:
        return asin(a.number_);
      case Op::acos:
        return acos(a.number_);
      case Op::atan:
        return atan(a.number_);
      case Op::sinh:
        return sinh(a.number_);
      case Op::cosh:
        return cosh(a.number_);
      case Op::tanh:
        return tanh(a.number_);
      default:
        return std::numeric_limits<Quadruple::Number>::quiet_NaN();
    }
  };
  return Quadruple(value());
}

Quadruple pow(const Quadruple& a, const Quadruple& p) {
  return Quadruple(boost::multiprecision::pow(a.number_, p.number_));
}

Quadruple atan2(const Quadruple& y, const Quadruple& x) {
  return Quadruple(boost::multiprecision::atan2(y.number_, x.number_));
}

}  // namespace courant
