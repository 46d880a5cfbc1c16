// The grammar of formulas: a Pratt parser that makes expressions as it reads.
#pragma once

#include <boost/container/static_vector.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "courant/core/language/formula_functions.hpp"
#include "courant/core/language/formula_lexer.hpp"
#include "courant/core/language/formula_value.hpp"
#include "courant/core/language/symbol_table.hpp"

namespace courant::formula {

// Reads one text, once, from left to right; every function throws FormulaError.
//
//   formula    = expression end
//   expression = operand { sign operand }            || && comparisons +- */ unary ^, tightest last
//   operand    = ("-" | "+" | "!") expression | primary { index }
//   primary    = number | name { index } ["'"] | "(" expression ")" | name "(" arguments ")"
//   index      = "[" expression "]"
//
// There is no syntax tree: the body of a sum is read again for each value of its index. What is
// known not to count (the body of an empty sum, the branch of an `if` with a known condition) is
// read too, so that it must be right, but its indices may be out of range.
class Parser {
 public:
  // `text` and `symbols` must outlive the parser; `text` is called `subject` in errors.
  Parser(std::string_view text, const SymbolTable& symbols, std::string_view subject = "formula");

  struct Subscript {
    Index value;
    std::size_t column;
  };
  using Subscripts = boost::container::static_vector<Subscript, 2>;

  // The whole text as a number.
  Expr formula();

  // The pieces of declarations and references (declaration.hpp).
  const Token& name();
  Subscripts subscripts(std::string_view what, std::string_view of);  // { "[" integer "]" }
  bool accept(TokenKind kind);
  void end();

 private:
  struct Loop {
    std::string_view index;
    Index value;
    Index nested_terms;  // of this loop and those around it, multiplied
  };

  Value expression(int binding);
  Value operand();
  Value primary();
  Value named(const Token& name);
  Value element(const Token& name, const Symbol& symbol, const Subscripts& subscripts);
  Value call(const Token& name);
  Value conditional(const Token& name);
  Value loop(const Token& name);
  Value connective(const Token& sign, const Value& left);
  Value read(bool counts, int binding);
  Subscript subscript(std::string_view what, std::string_view of);
  Index integer(std::string_view what, std::string_view of);
  const Token& new_index(std::string_view loop, std::string_view usage);
  void enter_loop(const Token& name, std::string_view index, Index first, Index terms);

  // The subscript, if it is one of that axis; 0 in a part that doesn't count.
  Index in_range(const Subscript& subscript, std::size_t axis, std::string_view name,
                 const Shape& shape, bool is_velocity) const;

  bool is_next(TokenKind kind) const { return token_->kind == kind; }
  void expect(TokenKind kind, const std::string& expected, std::string_view where = {});
  const Token& next() { return *token_++; }
  const Loop* find_loop(std::string_view name) const;
  std::string loop_values() const;
  std::string found() const;

  const SymbolTable& symbols_;
  const std::string_view subject_;
  const std::vector<Token> tokens_;
  const Token* token_;
  std::vector<Loop> loops_;
  Index terms_ = 0;
  Index open_terms_ = 0;  // of these, that are no numbers
  int depth_ = 0;
  int idle_ = 0;  // enclosing parts that don't count
};

}  // namespace courant::formula
