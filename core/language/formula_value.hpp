// What a part of a formula stands for while it is read: a number, a condition or an array.
#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "courant/core/expressions/expr.hpp"
#include "courant/core/language/formula_lexer.hpp"
#include "courant/core/numbers/digits.hpp"

namespace courant::formula {

// A number or a condition is `scalar` (conditions are 1 and 0, but are not taken for numbers), an
// array is `entries`. `column` is where it begins; `name` is how it is written if it is a name or
// an element, such as `r[i]'`, and empty otherwise.
struct Value {
  enum class Kind : std::uint8_t { number, condition, array };

  Kind kind;
  std::size_t column;
  Expr scalar = {};
  ExprVector entries = {};
  std::string_view name = {};
  // Of a number that is known: more of it than the double `scalar` has; null if that says all.
  std::shared_ptr<const Digits> digits = {};

  static Value number(std::size_t column, const Expr& scalar);
  static Value condition(std::size_t column, const Expr& scalar);
  static Value array(std::size_t column, ExprVector entries);
};

// The value where a number, a condition, an array is needed; throw FormulaError if it is another.
const Expr& as_number(const Value& value);
const Expr& as_condition(const Value& value);
const ExprVector& as_array(const Value& value);

// a + b, …, a^b, a < b, …, a && b. Arrays add and subtract; a number multiplies and divides them.
Value combine(const Token& sign, const Value& a, const Value& b);
Value negative(std::size_t column, const Value& a);
// op of numbers that are known, as they are written (known_number.hpp); nothing where they are not.
std::optional<Value> known_value(Op op, const Value& a);
std::optional<Value> known_value(Op op, const Value& a, const Value& b);

Value dot(std::size_t column, const Value& a, const Value& b);
Value cross(std::size_t column, const Value& a, const Value& b);
Value norm(std::size_t column, const Value& a);

}  // namespace courant::formula
