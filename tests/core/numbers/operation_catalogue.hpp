// Every operation of an expression graph with points of its domain, for tests that go over all of
// them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "courant/core/expressions/expr.hpp"

namespace courant {

struct OperationSample {
  std::string name;
  Op op;
  std::int32_t k;
  std::function<Expr(const ExprVector&)> apply;
  std::vector<VectorXd> points;  // operands where the operation is smooth
};

inline VectorXd operands(std::initializer_list<double> values) {
  VectorXd result(static_cast<Index>(values.size()));
  std::copy(values.begin(), values.end(), result.begin());
  return result;
}

inline std::vector<OperationSample> operation_catalogue() {
  using V = const ExprVector&;
  const std::vector<VectorXd> reals = {operands({-1.7}), operands({-0.3}), operands({1e-8}),
                                       operands({0.0}),  operands({0.4}),  operands({2.9})};
  const std::vector<VectorXd> positive = {operands({1e-3}), operands({0.2}), operands({1.0}),
                                          operands({7.5})};
  const std::vector<VectorXd> fractions = {operands({-0.9}), operands({-0.2}), operands({0.0}),
                                           operands({0.7})};
  const std::vector<VectorXd> nonzero = {operands({-1.7}), operands({-0.3}), operands({0.4}),
                                         operands({2.9})};
  const std::vector<VectorXd> pairs = {operands({0.3, -1.2}), operands({-2.0, 0.7}),
                                       operands({1.1, 2.3})};
  const std::vector<VectorXd> positive_pairs = {operands({0.3, -1.2}), operands({2.0, 0.7}),
                                                operands({1.1, 2.3})};
  std::vector<OperationSample> all = {
      {"negate", Op::negate, 0, [](V u) { return -u[0]; }, reals},
      {"add", Op::add, 0, [](V u) { return u[0] + u[1]; }, pairs},
      {"subtract", Op::subtract, 0, [](V u) { return u[0] - u[1]; }, pairs},
      {"multiply", Op::multiply, 0, [](V u) { return u[0] * u[1]; }, pairs},
      {"divide", Op::divide, 0, [](V u) { return u[0] / u[1]; }, pairs},
      {"sqrt", Op::sqrt, 0, [](V u) { return sqrt(u[0]); }, positive},
      {"exp", Op::exp, 0, [](V u) { return exp(u[0]); }, reals},
      {"log", Op::log, 0, [](V u) { return log(u[0]); }, positive},
      {"sin", Op::sin, 0, [](V u) { return sin(u[0]); }, reals},
      {"cos", Op::cos, 0, [](V u) { return cos(u[0]); }, reals},
      {"tan", Op::tan, 0, [](V u) { return tan(u[0]); }, fractions},
      {"asin", Op::asin, 0, [](V u) { return asin(u[0]); }, fractions},
      {"acos", Op::acos, 0, [](V u) { return acos(u[0]); }, fractions},
      {"atan", Op::atan, 0, [](V u) { return atan(u[0]); }, reals},
      {"sinh", Op::sinh, 0, [](V u) { return sinh(u[0]); }, reals},
      {"cosh", Op::cosh, 0, [](V u) { return cosh(u[0]); }, reals},
      {"tanh", Op::tanh, 0, [](V u) { return tanh(u[0]); }, reals},
      {"abs", Op::abs, 0, [](V u) { return abs(u[0]); }, nonzero},
      {"sign", Op::sign, 0, [](V u) { return sign(u[0]); }, nonzero},
      {"pow", Op::pow, 0, [](V u) { return pow(u[0], u[1]); }, positive_pairs},
      {"atan2", Op::atan2, 0, [](V u) { return atan2(u[0], u[1]); }, pairs},
      {"min", Op::min, 0, [](V u) { return min(u[0], u[1]); }, pairs},
      {"max", Op::max, 0, [](V u) { return max(u[0], u[1]); }, pairs},
      {"less", Op::less, 0, [](V u) { return u[0] < u[1]; }, pairs},
      {"less_equal", Op::less_equal, 0, [](V u) { return u[0] <= u[1]; }, pairs},
      {"equal", Op::equal, 0, [](V u) { return equal(u[0], u[1]); }, pairs},
      {"logical_and", Op::logical_and, 0, [](V u) { return logical_and(u[0], u[1]); }, pairs},
      {"logical_or", Op::logical_or, 0, [](V u) { return logical_or(u[0], u[1]); }, pairs},
      {"logical_not", Op::logical_not, 0, [](V u) { return logical_not(u[0]); }, nonzero},
      {"select",
       Op::select,
       0,
       [](V u) { return select(u[0], u[1], u[2]); },
       {operands({1.0, 0.3, -0.7}), operands({0.0, 0.3, -0.7})}},
  };
  for (const int k : {-3, -1, 3, 4, 7})
    all.push_back({"power " + std::to_string(k), Op::power, k, [k](V u) { return pow(u[0], k); },
                   k < 0 ? nonzero : reals});
  for (const int k : {0, 1, 2, 3})
    all.push_back({"stumpff " + std::to_string(k),
                   Op::stumpff,
                   k,
                   [k](V u) { return stumpff(k, u[0]); },
                   {operands({0.0}), operands({1e-8}), operands({0.9}), operands({1.1}),
                    operands({7.0}), operands({-3.0}), operands({30.0})}});
  for (const int k : {0, 1, 2})
    all.push_back({"arccos_factor " + std::to_string(k),
                   Op::arccos_factor,
                   k,
                   [k](V u) { return arccos_factor(k, u[0]); },
                   {operands({1.0}), operands({1.0 - 1e-8}), operands({0.6}), operands({-0.5}),
                    operands({1.7}), operands({5.0})}});
  return all;
}

}  // namespace courant
