#include "courant/core/language/formula_functions.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace courant::formula {
namespace {

using Arguments = NamedFunction::Arguments;

constexpr std::size_t kAny = std::numeric_limits<std::size_t>::max();

template <Expr (*f)(const Expr&), Op op = Op::constant>
Value unary(std::size_t column, Arguments x) {
  if (op != Op::constant)
    if (auto result = known_value(op, x[0])) {
      result->column = column;
      return *result;
    }
  return Value::number(column, f(as_number(x[0])));
}

template <Expr (*f)(const Expr&, const Expr&)>
Value binary(std::size_t column, Arguments x) {
  return Value::number(column, f(as_number(x[0]), as_number(x[1])));
}

// f(…f(f(x₀, x₁), x₂)…)
template <Expr (*f)(const Expr&, const Expr&)>
Value folded(std::size_t column, Arguments x) {
  Expr result = as_number(x[0]);
  for (const Value& next : x.subspan(1)) result = f(result, as_number(next));
  return Value::number(column, result);
}

Value dot(std::size_t column, Arguments x) { return dot(column, x[0], x[1]); }
Value cross(std::size_t column, Arguments x) { return cross(column, x[0], x[1]); }
Value norm(std::size_t column, Arguments x) { return norm(column, x[0]); }

constexpr std::array kFunctions{
    NamedFunction{"sqrt", 1, 1, unary<sqrt, Op::sqrt>},
    NamedFunction{"exp", 1, 1, unary<exp, Op::exp>},
    NamedFunction{"log", 1, 1, unary<log, Op::log>},
    NamedFunction{"sin", 1, 1, unary<sin, Op::sin>},
    NamedFunction{"cos", 1, 1, unary<cos, Op::cos>},
    NamedFunction{"tan", 1, 1, unary<tan, Op::tan>},
    NamedFunction{"asin", 1, 1, unary<asin, Op::asin>},
    NamedFunction{"acos", 1, 1, unary<acos, Op::acos>},
    NamedFunction{"atan", 1, 1, unary<atan, Op::atan>},
    NamedFunction{"atan2", 2, 2, binary<atan2>},
    NamedFunction{"sinh", 1, 1, unary<sinh, Op::sinh>},
    NamedFunction{"cosh", 1, 1, unary<cosh, Op::cosh>},
    NamedFunction{"tanh", 1, 1, unary<tanh, Op::tanh>},
    NamedFunction{"abs", 1, 1, unary<abs>},
    NamedFunction{"min", 2, kAny, folded<min>},
    NamedFunction{"max", 2, kAny, folded<max>},
    NamedFunction{"pow", 2, 2, binary<pow>},
    NamedFunction{"sign", 1, 1, unary<sign>},
    NamedFunction{"dot", 2, 2, dot},
    NamedFunction{"cross", 2, 2, cross},
    NamedFunction{"norm", 1, 1, norm},
    NamedFunction{"sum", 4, 4, nullptr},
    NamedFunction{"prod", 4, 4, nullptr},
    NamedFunction{"if", 3, 3, nullptr},
};

}  // namespace

const NamedFunction* find_function(std::string_view name) {
  const auto found = std::find_if(kFunctions.begin(), kFunctions.end(),
                                  [&](const NamedFunction& f) { return f.name == name; });
  return found == kFunctions.end() ? nullptr : &*found;
}

std::vector<std::string> function_names() {
  std::vector<std::string> names;
  for (const NamedFunction& f : kFunctions) names.emplace_back(f.name);
  return names;
}

}  // namespace courant::formula
