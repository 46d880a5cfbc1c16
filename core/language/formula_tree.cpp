#include "courant/core/language/formula_tree.hpp"

#include <utility>

#include "courant/core/language/formula_error.hpp"
#include "courant/core/language/formula_lexer.hpp"

namespace courant {
namespace {

using formula::binding_of;
using formula::kUnary;
using formula::Token;
using formula::TokenKind;
using Kind = FormulaTree::Kind;

constexpr int kDeepestNesting = 100;

// What is no formula.
struct NoFormula {};

class TreeParser {
 public:
  explicit TreeParser(std::string_view text) : tokens_(formula::tokenize(text)) {}

  FormulaTree formula() {
    FormulaTree tree = expression(0);
    if (!is_next(TokenKind::end)) throw NoFormula();
    return tree;
  }

 private:
  FormulaTree expression(int binding) {
    if (++depth_ > kDeepestNesting) throw NoFormula();
    FormulaTree left = operand();
    while (binding_of(tokens_[at_].kind) > binding) {
      const Token sign = next();
      const bool to_the_right = sign.kind == TokenKind::hat;
      FormulaTree right = expression(to_the_right ? kUnary : binding_of(sign.kind));
      left = {Kind::operation, std::string(sign.text), {std::move(left), std::move(right)}};
    }
    --depth_;
    return left;
  }

  FormulaTree operand() {
    for (const TokenKind kind : {TokenKind::minus, TokenKind::plus, TokenKind::logical_not})
      if (is_next(kind)) {
        const Token sign = next();
        return {Kind::sign, std::string(sign.text), {expression(kUnary)}};
      }
    return indexed(primary());
  }

  FormulaTree primary() {
    if (is_next(TokenKind::number)) return {Kind::number, std::string(next().text)};
    if (is_next(TokenKind::left_parenthesis)) {
      next();
      FormulaTree inner = expression(0);
      expect(TokenKind::right_parenthesis);
      return inner;
    }
    if (!is_next(TokenKind::name)) throw NoFormula();
    FormulaTree name = {Kind::name, std::string(next().text)};
    if (!is_next(TokenKind::left_parenthesis)) return name;
    next();
    name.kind = Kind::call;
    do name.operands.push_back(expression(0));
    while (accept(TokenKind::comma));
    expect(TokenKind::right_parenthesis);
    return name;
  }

  // The primes of r[2]' belong to the whole.
  FormulaTree indexed(FormulaTree of) {
    while (is_next(TokenKind::left_bracket)) {
      next();
      FormulaTree index = expression(0);
      expect(TokenKind::right_bracket);
      of = {Kind::element, "", {std::move(of), std::move(index)}};
    }
    while (is_next(TokenKind::prime)) {
      next();
      FormulaTree* array = &of;
      while (array->kind == Kind::element) array = &array->operands[0];
      if (array->kind != Kind::name) throw NoFormula();
      array->text += '\'';
    }
    return of;
  }

  bool is_next(TokenKind kind) const { return tokens_[at_].kind == kind; }
  Token next() { return tokens_[at_++]; }
  bool accept(TokenKind kind) {
    if (!is_next(kind)) return false;
    next();
    return true;
  }
  void expect(TokenKind kind) {
    if (!accept(kind)) throw NoFormula();
  }

  std::vector<Token> tokens_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

// Where the = of an equation is: none of ==, <=, >=, !=.
std::size_t equals_sign(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') continue;
    const bool doubled = i + 1 < text.size() && text[i + 1] == '=';
    if (doubled) ++i;
    const bool compares =
        doubled || (i > 0 && (text[i - 1] == '<' || text[i - 1] == '>' || text[i - 1] == '!'));
    if (!compares) return i;
  }
  return std::string_view::npos;
}

}  // namespace

std::optional<FormulaTree> formula_tree(std::string_view text) {
  try {
    const std::size_t equals = equals_sign(text);
    if (equals == std::string_view::npos) return TreeParser(text).formula();
    FormulaTree left = TreeParser(text.substr(0, equals)).formula();
    return FormulaTree{
        Kind::equation, "=", {std::move(left), TreeParser(text.substr(equals + 1)).formula()}};
  } catch (const FormulaError&) {
    return std::nullopt;
  } catch (const NoFormula&) {
    return std::nullopt;
  }
}

}  // namespace courant
