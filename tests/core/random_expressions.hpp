// Random expressions, for tests of laws that hold for all of them.
#pragma once

#include <random>

#include "courant/core/expressions/expr.hpp"

namespace courant {

// `count` values, each made by a random operation from x and earlier ones. `smooth` leaves out the
// operations that have kinks and conditions. Operands are brought into the domain of the operation,
// so that most values are finite.
inline ExprVector random_expressions(std::mt19937& generator, const ExprVector& x, Index count,
                                     bool smooth) {
  std::vector<Expr> pool(x.begin(), x.end());
  const auto draw = [&](std::size_t size) {
    return std::uniform_int_distribution<std::size_t>(0, size - 1)(generator);
  };
  const auto constant = [&] {
    return Expr(std::uniform_real_distribution<double>(-2.0, 2.0)(generator));
  };
  const auto operand = [&] {
    // Mostly of the last ones, so that expressions become deep.
    const std::size_t recent = std::min<std::size_t>(pool.size(), 8);
    if (draw(8) == 0) return constant();
    return draw(4) == 0 ? pool[draw(pool.size())] : pool[pool.size() - 1 - draw(recent)];
  };
  const auto next = [&]() -> Expr {
    const Expr a = operand(), b = operand(), c = operand();
    const Expr bounded = tanh(a), positive = 0.3 + square(bounded);
    switch (draw(smooth ? 23 : 33)) {
      case 0:
        return a + b;
      case 1:
        return a - b;
      case 2:
        return bounded * b;
      case 3:
        return b / (1.0 + positive);
      case 4:
        return sqrt(positive);
      case 5:
        return exp(bounded);
      case 6:
        return log(positive);
      case 7:
        return sin(a);
      case 8:
        return cos(a);
      case 9:
        return tan(bounded);
      case 10:
        return asin(0.9 * bounded);
      case 11:
        return acos(0.9 * bounded);
      case 12:
        return atan(a);
      case 13:
        return sinh(bounded);
      case 14:
        return cosh(bounded);
      case 15:
        return tanh(a);
      case 16:
        return pow(bounded, static_cast<int>(2 + draw(4)));
      case 17:
        return pow(positive, -static_cast<int>(1 + draw(3)));
      case 18:
        return pow(positive, tanh(b));
      case 19:
        return atan2(positive, b);
      case 20:
        return stumpff(static_cast<int>(draw(5)), 4.0 * bounded + 30.0 * square(tanh(b)));
      case 21:
        return arccos_factor(static_cast<int>(draw(4)), bounded + 3.0 * square(tanh(b)));
      case 22:
        return -a;
      case 23:
        return abs(a);
      case 24:
        return sign(a) + b;
      case 25:
        return min(a, b);
      case 26:
        return max(a, b);
      case 27:
        return select(a < b, c, a);
      case 28:
        return select(a <= b, c, b);
      case 29:
        return select(logical_and(a < b, b < c), a, c);
      case 30:
        return select(logical_or(a < b, b < c), sqrt(a), c);  // may not be a number
      case 31:
        return select(logical_not(equal(sign(a), 1.0)), log(b), c);
      default:
        return select(b, a, c);
    }
  };
  ExprVector result(count);
  for (Expr& value : result) pool.push_back(value = next());
  return result;
}

inline VectorXd random_point(std::mt19937& generator, Index size) {
  std::uniform_real_distribution<double> coordinate(-1.5, 1.5);
  return VectorXd::NullaryExpr(size, [&] { return coordinate(generator); });
}

}  // namespace courant
