#include "courant/core/language/formula_parser.hpp"

#include <algorithm>
#include <cmath>

#include "courant/core/language/formula_error.hpp"
#include "courant/core/words/spelling.hpp"
#include "courant/core/words/text_layout.hpp"

namespace courant::formula {
namespace {

constexpr int kDeepest = 200;  // a nesting no person writes, far from the end of the stack
constexpr Index kMostTerms = 1'000'000;  // of all sums together: a second
// Of these that are no numbers: enough for an energy of 10⁵ coordinates with five terms of each. The ladder of
// a system with so many takes a minute.
constexpr Index kMostOpenTerms = 500'000;

bool begins_operand(TokenKind kind) {
  return kind == TokenKind::number || kind == TokenKind::name ||
         kind == TokenKind::left_parenthesis;
}

[[noreturn]] void fail(const Token& at, const std::string& message) {
  throw FormulaError(at.column, message);
}

std::string quoted(std::string_view text) { return std::string(1, '"').append(text) += '"'; }

// `r[20][3]`, `r[20][3]'`
std::string with_shape(std::string_view name, const Shape& shape, bool is_velocity) {
  std::string text(name);
  for (const Index n : shape) text += "[" + std::to_string(n) + "]";
  return text + (is_velocity ? "'" : "");
}

void check_argument_count(const Token& name, const NamedFunction& function, std::size_t count) {
  if (function.least <= count && count <= function.most) return;
  const std::string at_least = function.least == function.most ? "" : "at least ";
  fail(name, quoted(name.text) + " takes " + at_least +
                 counted(std::ptrdiff_t(function.least), "argument") + ", found " +
                 std::to_string(count));
}

}  // namespace

Parser::Parser(std::string_view text, const SymbolTable& symbols, std::string_view subject)
    : symbols_(symbols), subject_(subject), tokens_(tokenize(text)), token_(tokens_.data()) {}

Expr Parser::formula() {
  const Value value = expression(0);
  end();
  return as_number(value);
}

const Token& Parser::name() {
  if (!is_next(TokenKind::name)) fail(*token_, "expected a name, found " + found());
  return next();
}

Parser::Subscripts Parser::subscripts(std::string_view what, std::string_view of) {
  Subscripts subscripts;
  while (subscripts.size() < subscripts.capacity() && is_next(TokenKind::left_bracket))
    subscripts.push_back(subscript(what, of));
  return subscripts;
}

bool Parser::accept(TokenKind kind) {
  if (!is_next(kind)) return false;
  ++token_;
  return true;
}

void Parser::expect(TokenKind kind, const std::string& expected, std::string_view where) {
  if (token_->kind == kind) {
    if (kind != TokenKind::end) ++token_;
    return;
  }
  if (begins_operand(token_->kind)) fail(*token_, "expected an operator, found " + found());
  fail(*token_, "expected " + expected + ", found " + found() + std::string(where));
}

void Parser::end() {
  if (!is_next(TokenKind::end))
    fail(*token_, "expected end of " + std::string(subject_) + ", found " + found());
}

Value Parser::expression(int binding) {
  if (++depth_ > kDeepest)
    fail(*token_, "nested too deep; expected at most " + std::to_string(kDeepest) + " levels");
  Value left = operand();
  while (binding_of(token_->kind) > binding) {
    const Token& sign = next();
    switch (sign.kind) {
      case TokenKind::logical_and:
      case TokenKind::logical_or:
        left = connective(sign, left);
        break;
      case TokenKind::hat:  // the next ^ belongs to the exponent
        left = combine(sign, left, expression(kUnary));
        break;
      default:
        left = combine(sign, left, expression(binding_of(sign.kind)));
    }
  }
  if (begins_operand(token_->kind)) fail(*token_, "expected an operator, found " + found());
  --depth_;
  return left;
}

Value Parser::operand() {
  const Token& first = *token_;
  switch (first.kind) {
    case TokenKind::minus:
      next();
      return negative(first.column, expression(kUnary));
    case TokenKind::plus:
      next();
      return expression(kUnary);
    case TokenKind::logical_not:
      next();
      return Value::condition(first.column, logical_not(as_condition(expression(kUnary))));
    default:
      break;
  }
  Value value = primary();
  while (is_next(TokenKind::left_bracket)) {
    const ExprVector& entries = as_array(value);
    const Index i = in_range(subscript("index", "array"), 0, "array", {entries.size()}, false);
    value = Value::number(value.column, entries[i]);
  }
  return value;
}

Value Parser::primary() {
  const Token& token = *token_;
  switch (token.kind) {
    case TokenKind::number:
      next();
      return Value::number(token.column, token.number);
    case TokenKind::name:
      next();
      return is_next(TokenKind::left_parenthesis) ? call(token) : named(token);
    case TokenKind::left_parenthesis: {
      next();
      Value value = expression(0);
      expect(TokenKind::right_parenthesis, "\")\"");
      return value;
    }
    default:
      fail(token, "expected a number, a name, \"-\" or \"(\", found " + found());
  }
}

Value Parser::named(const Token& name) {
  if (const Loop* loop = find_loop(name.text)) {
    Value value = Value::number(name.column, static_cast<double>(loop->value));
    value.name = name.text;
    return value;
  }
  const Symbol* symbol = symbols_.find(name.text);
  const Symbol* velocity = symbols_.find_velocity(name.text);
  if (symbol == nullptr && velocity == nullptr) {
    if (find_function(name.text) != nullptr)
      fail(*token_, "expected \"(\" after " + quoted(name.text) + ", found " + found());
    std::vector<std::string> known = symbols_.names();
    for (const Loop& loop : loops_) known.emplace_back(loop.index);
    fail(name, "unknown name " + quoted(name.text) + did_you_mean(name.text, known));
  }

  const Subscripts indices = subscripts("index", name.text);
  if (accept(TokenKind::prime)) {
    symbol = velocity;
    if (symbol == nullptr)
      fail(name, "velocity " + std::string(name.text) + "' is not available here");
    if (is_next(TokenKind::prime))
      fail(*token_,
           "formulas have no second derivatives; expected v' of an unknown v with the equation " +
               std::string(name.text) + "' - v");
  } else if (symbol == nullptr) {
    fail(name, std::string(name.text) + " is not available here; expected its velocity " +
                   std::string(name.text) + "'");
  }
  return element(name, *symbol, indices);
}

Value Parser::element(const Token& name, const Symbol& symbol, const Subscripts& subscripts) {
  const Shape& shape = symbol.shape;
  const Token& last = token_[-1];
  const bool is_velocity = last.kind == TokenKind::prime;
  const std::string_view written(
      name.text.data(),
      static_cast<std::size_t>(last.text.data() + last.text.size() - name.text.data()));
  if (subscripts.size() > shape.size())
    throw FormulaError(subscripts[shape.size()].column,
                       with_shape(name.text, shape, is_velocity) + " takes " +
                           std::to_string(shape.size()) +
                           (shape.size() == 1 ? " index" : " indices") + ", found " +
                           std::to_string(subscripts.size()));

  Index first = 0, size = element_count(shape);
  for (std::size_t axis = 0; axis < subscripts.size(); ++axis) {
    size /= shape[axis];
    first += size * in_range(subscripts[axis], axis, name.text, shape, is_velocity);
  }
  Value value{};
  switch (shape.size() - subscripts.size()) {
    case 0:
      value = Value::number(name.column, symbol.values[first]);
      break;
    case 1:
      value = Value::array(name.column, symbol.values.segment(first, size));
      break;
    default:
      fail(name, std::string(written) + " is an array of " + std::to_string(shape[0]) + "×" +
                     std::to_string(shape[1]) + "; expected an element such as " +
                     std::string(name.text) + "[0][0]" + (is_velocity ? "'" : ""));
  }
  value.name = written;
  return value;
}

Value Parser::call(const Token& name) {
  const NamedFunction* function = find_function(name.text);
  if (function == nullptr) {
    if (symbols_.find(name.text) != nullptr || find_loop(name.text) != nullptr)
      fail(*token_, "expected an operator after " + quoted(name.text) + ", found \"(\"");
    fail(name, "unknown function " + quoted(name.text) + did_you_mean(name.text, function_names()));
  }
  next();
  if (name.text == "if") return conditional(name);
  if (function->apply == nullptr) return loop(name);
  std::vector<Value> arguments;
  if (!is_next(TokenKind::right_parenthesis)) {
    do arguments.push_back(expression(0));
    while (accept(TokenKind::comma));
  }
  const std::size_t count = arguments.size();
  expect(TokenKind::right_parenthesis, count < function->least  ? "\",\""
                                       : count < function->most ? "\",\" or \")\""
                                                                : "\")\"");
  check_argument_count(name, *function, count);
  return function->apply(name.column, arguments);
}

Value Parser::conditional(const Token& name) {
  constexpr std::string_view kUsage = " in if(condition, then, otherwise)";
  const Expr condition = as_condition(expression(0));
  const bool is_known = condition.is_constant();
  expect(TokenKind::comma, "\",\"", kUsage);
  const Expr then = as_number(read(!is_known || condition.value() != 0, 0));
  expect(TokenKind::comma, "\",\"", kUsage);
  const Expr otherwise = as_number(read(!is_known || condition.value() == 0, 0));
  expect(TokenKind::right_parenthesis, "\")\"", kUsage);
  return Value::number(name.column, select(condition, then, otherwise));
}

Value Parser::loop(const Token& name) {
  const bool is_sum = name.text == "sum";
  const std::string usage = " in " + std::string(name.text) + "(index, first, last, term)";
  const Token& index = new_index(name.text, usage);
  expect(TokenKind::comma, "\",\"", usage);
  const Index first = integer("bound", name.text);
  expect(TokenKind::comma, "\",\"", usage);
  const Index last = integer("bound", name.text);
  expect(TokenKind::comma, "\",\"", usage);

  const Index terms = idle_ > 0 || last < first ? 0 : last - first + 1;
  enter_loop(name, index.text, first, terms);
  const Token* term = token_;
  if (terms == 0) as_number(read(false, 0));
  const Token sign{is_sum ? TokenKind::plus : TokenKind::times, name.column, name.text};
  Value total = Value::number(name.column, is_sum ? 0.0 : 1.0);
  for (Index i = first; i < first + terms; ++i) {
    token_ = term;
    loops_.back().value = i;
    const Value next_term = expression(0);
    if (!as_number(next_term).is_constant() && ++open_terms_ > kMostOpenTerms)
      fail(name, quoted(name.text) + " is too long; expected at most " +
                     std::to_string(kMostOpenTerms) + " terms with unknowns in a formula");
    total = combine(sign, total, next_term);
  }
  loops_.pop_back();
  expect(TokenKind::right_parenthesis, "\")\"", usage);
  return total;
}

const Token& Parser::new_index(std::string_view loop, std::string_view usage) {
  const Token& index = *token_;
  if (index.kind != TokenKind::name)
    fail(index, "expected a name for the index, found " + found() + std::string(usage));
  if (symbols_.find(index.text) != nullptr || symbols_.find_velocity(index.text) != nullptr ||
      find_function(index.text) != nullptr || find_loop(index.text) != nullptr)
    fail(index, quoted(index.text) +
                    " has a meaning already; expected a new name for the index of " +
                    std::string(loop));
  return next();
}

void Parser::enter_loop(const Token& name, std::string_view index, Index first, Index terms) {
  const Index around = loops_.empty() ? 1 : loops_.back().nested_terms;
  // Refused before the work is done, taking nested loops for a rectangle; double can't overflow.
  const double nested_terms = static_cast<double>(around) * static_cast<double>(terms);
  if (nested_terms > kMostTerms || (terms_ += terms) > kMostTerms)
    fail(name, quoted(name.text) + " is too long; expected at most " + std::to_string(kMostTerms) +
                   " terms in a formula");
  loops_.push_back({index, first, around * std::max<Index>(terms, 1)});
}

// In `a && b` with a known to be false, b does not count; likewise for `||`.
Value Parser::connective(const Token& sign, const Value& left) {
  const bool is_and = sign.kind == TokenKind::logical_and;
  const bool is_decided = as_condition(left).is_constant(is_and ? 0.0 : 1.0);
  const Value right = read(!is_decided, binding_of(sign.kind));
  as_condition(right);
  return is_decided ? left : combine(sign, left, right);
}

// An expression that counts or not.
Value Parser::read(bool counts, int binding) {
  idle_ += !counts;
  Value value = expression(binding);
  idle_ -= !counts;
  return value;
}

Parser::Subscript Parser::subscript(std::string_view what, std::string_view of) {
  expect(TokenKind::left_bracket, "\"[\"");
  const std::size_t column = token_->column;
  const Index value = integer(what, of);
  expect(TokenKind::right_bracket, "\"]\"");
  return {value, column};
}

Index Parser::integer(std::string_view what, std::string_view of) {
  const Value value = expression(0);
  const Expr& number = as_number(value);
  const double x = number.is_constant() ? number.value() : 0.5;
  if (x == std::floor(x) && std::fabs(x) <= 0x1p53) return static_cast<Index>(x);
  if (idle_ > 0) return 0;
  throw FormulaError(value.column,
                     std::string(what) + " of " + std::string(of) + " is " + to_string(number, 60) +
                         "; expected " +
                         (number.is_constant() ? "an integer" : "a constant integer") +
                         loop_values());
}

Index Parser::in_range(const Subscript& subscript, std::size_t axis, std::string_view name,
                       const Shape& shape, bool is_velocity) const {
  if (subscript.value >= 0 && subscript.value < shape[axis]) return subscript.value;
  if (idle_ > 0) return 0;
  throw FormulaError(subscript.column, "index " + std::to_string(subscript.value) +
                                           " is out of range for " +
                                           with_shape(name, shape, is_velocity) + " (0 … " +
                                           std::to_string(shape[axis] - 1) + ")" + loop_values());
}

const Parser::Loop* Parser::find_loop(std::string_view name) const {
  const auto found = std::find_if(loops_.begin(), loops_.end(),
                                  [&](const Loop& loop) { return loop.index == name; });
  return found == loops_.end() ? nullptr : &*found;
}

// `, where i = 4, j = 2` inside loops.
std::string Parser::loop_values() const {
  std::string text;
  for (const Loop& loop : loops_)
    text += (text.empty() ? ", where " : ", ") + std::string(loop.index) + " = " +
            std::to_string(loop.value);
  return text;
}

std::string Parser::found() const {
  return is_next(TokenKind::end) ? "end of " + std::string(subject_) : quoted(token_->text);
}

}  // namespace courant::formula
