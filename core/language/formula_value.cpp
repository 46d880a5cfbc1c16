#include "courant/core/language/formula_value.hpp"

#include <stdexcept>
#include <string>
#include <utility>

#include "courant/core/language/formula_error.hpp"
#include "courant/core/language/known_number.hpp"

namespace courant::formula {
namespace {

std::string subject(const Value& value) {
  return value.name.empty() ? "this" : std::string(value.name);
}

std::string description(const Value& value) {
  switch (value.kind) {
    case Value::Kind::number:
      return "a number";
    case Value::Kind::condition:
      return "a condition";
    default:
      return "an array of " + std::to_string(value.entries.size());
  }
}

[[noreturn]] void refuse(const Value& value, const std::string& expected) {
  throw FormulaError(value.column,
                     subject(value) + " is " + description(value) + "; expected " + expected);
}

// `x[0]` of `x`, `r[2][0]'` of `r[2]'`
std::string first_element(std::string_view name) {
  const bool is_velocity = name.ends_with('\'');
  if (is_velocity) name.remove_suffix(1);
  return std::string(name) + "[0]" + (is_velocity ? "'" : "");
}

bool is_known_number(const Value& value) {
  return value.kind == Value::Kind::number && value.scalar.is_constant();
}

KnownNumber known_number(const Value& value) { return {value.scalar.value(), value.digits}; }

std::optional<Value> value_of(std::size_t column, const std::optional<KnownNumber>& number) {
  if (!number) return std::nullopt;
  Value value = Value::number(column, number->value);
  value.digits = number->digits;
  return value;
}

bool is_array(const Value& value) { return value.kind == Value::Kind::array; }

void check_sizes(std::size_t column, std::string_view operation, const Value& a, const Value& b) {
  if (a.entries.size() != b.entries.size())
    throw FormulaError(column, std::string(operation) + " of " + description(a) + " and " +
                                   description(b) + "; expected one size");
}

Expr inner_product(const ExprVector& a, const ExprVector& b) {
  Expr sum = 0;
  for (Index i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

Expr comparison(TokenKind sign, const Expr& a, const Expr& b) {
  switch (sign) {
    case TokenKind::less:
      return a < b;
    case TokenKind::less_equal:
      return a <= b;
    case TokenKind::greater:
      return a > b;
    case TokenKind::greater_equal:
      return a >= b;
    case TokenKind::equal:
      return equal(a, b);
    case TokenKind::unequal:
      return logical_not(equal(a, b));
    default:
      throw std::logic_error("formula::comparison: sign is not of a comparison.");
  }
}

}  // namespace

Value Value::number(std::size_t column, const Expr& scalar) {
  return {.kind = Kind::number, .column = column, .scalar = scalar};
}

Value Value::condition(std::size_t column, const Expr& scalar) {
  return {.kind = Kind::condition, .column = column, .scalar = scalar};
}

Value Value::array(std::size_t column, ExprVector entries) {
  return {.kind = Kind::array, .column = column, .entries = std::move(entries)};
}

const Expr& as_number(const Value& value) {
  if (is_array(value) && !value.name.empty())
    refuse(value, "an element such as " + first_element(value.name));
  if (value.kind != Value::Kind::number) refuse(value, "a number");
  return value.scalar;
}

const Expr& as_condition(const Value& value) {
  if (value.kind != Value::Kind::condition) refuse(value, "a condition such as x > 0");
  return value.scalar;
}

const ExprVector& as_array(const Value& value) {
  if (!is_array(value)) refuse(value, "an array");
  return value.entries;
}

Value combine(const Token& sign, const Value& a, const Value& b) {
  const auto number = [&](const Expr& result) { return Value::number(a.column, result); };
  const auto array = [&](ExprVector result) { return Value::array(a.column, std::move(result)); };
  const auto condition = [&](const Expr& result) { return Value::condition(a.column, result); };
  const bool are_arrays = is_array(a) && is_array(b);
  switch (sign.kind) {
    case TokenKind::plus:
      if (const auto result = known_value(Op::add, a, b)) return *result;
      if (!are_arrays) return number(as_number(a) + as_number(b));
      check_sizes(sign.column, "sum", a, b);
      return array(a.entries + b.entries);
    case TokenKind::minus:
      if (const auto result = known_value(Op::subtract, a, b)) return *result;
      if (!are_arrays) return number(as_number(a) - as_number(b));
      check_sizes(sign.column, "difference", a, b);
      return array(a.entries - b.entries);
    case TokenKind::times:
      if (is_array(a)) return array(a.entries * as_number(b));
      if (is_array(b)) return array(as_number(a) * b.entries);
      if (const auto result = known_value(Op::multiply, a, b)) return *result;
      return number(as_number(a) * as_number(b));
    case TokenKind::over:
      if (is_array(a)) return array(a.entries / as_number(b));
      if (const auto result = known_value(Op::divide, a, b)) return *result;
      return number(as_number(a) / as_number(b));
    case TokenKind::hat:
      if (const auto result = known_value(Op::pow, a, b)) return *result;
      return number(pow(as_number(a), as_number(b)));
    case TokenKind::logical_and:
      return condition(logical_and(as_condition(a), as_condition(b)));
    case TokenKind::logical_or:
      return condition(logical_or(as_condition(a), as_condition(b)));
    default:
      if (a.kind == Value::Kind::condition)
        throw FormulaError(sign.column, "comparisons do not chain; expected a < b && b < c");
      return condition(comparison(sign.kind, as_number(a), as_number(b)));
  }
}

std::optional<Value> known_value(Op op, const Value& a) {
  return is_known_number(a) ? value_of(a.column, known(op, known_number(a))) : std::nullopt;
}

std::optional<Value> known_value(Op op, const Value& a, const Value& b) {
  if (!is_known_number(a) || !is_known_number(b)) return std::nullopt;
  return value_of(a.column, known(op, known_number(a), known_number(b)));
}

Value negative(std::size_t column, const Value& a) {
  if (is_array(a)) return Value::array(column, -a.entries);
  Value result = Value::number(column, -as_number(a));
  if (a.digits) result.digits = std::make_shared<const Digits>(-*a.digits);
  return result;
}

Value dot(std::size_t column, const Value& a, const Value& b) {
  const ExprVector &u = as_array(a), &v = as_array(b);
  check_sizes(column, "dot", a, b);
  return Value::number(column, inner_product(u, v));
}

Value cross(std::size_t column, const Value& a, const Value& b) {
  const ExprVector &u = as_array(a), &v = as_array(b);
  if (u.size() != 3) refuse(a, "an array of 3");
  if (v.size() != 3) refuse(b, "an array of 3");
  ExprVector w(3);
  for (Index i = 0; i < 3; ++i) {
    const Index j = (i + 1) % 3, k = (i + 2) % 3;
    w[i] = u[j] * v[k] - u[k] * v[j];
  }
  return Value::array(column, std::move(w));
}

Value norm(std::size_t column, const Value& a) {
  const ExprVector& u = as_array(a);
  return Value::number(column, sqrt(inner_product(u, u)));
}

}  // namespace courant::formula
