#include "courant/core/language/formula.hpp"

#include <algorithm>
#include <cstddef>

#include "courant/core/language/formula_parser.hpp"

namespace courant {
namespace {

using formula::Token;
using formula::TokenKind;

// The token after `x[…][…]`, where `name` is x.
const Token& after_indices(const Token* name) {
  const Token* token = name + 1;
  for (int depth = 0; token->kind != TokenKind::end; ++token) {
    if (token->kind == TokenKind::left_bracket)
      ++depth;
    else if (depth == 0)
      break;
    else if (token->kind == TokenKind::right_bracket)
      --depth;
  }
  return *token;
}

}  // namespace

Expr parse_formula(std::string_view text, const SymbolTable& symbols) {
  return formula::Parser(text, symbols).formula();
}

std::vector<std::string> names_used(std::string_view text) {
  const std::vector<Token> tokens = formula::tokenize(text);
  const SymbolTable constants;
  struct LoopIndex {
    std::string_view name;
    int depth;  // of the parentheses around the term
  };
  std::vector<LoopIndex> loop_indices;
  std::vector<std::string> names;
  int depth = 0;
  for (const Token& token : tokens) {
    if (token.kind == TokenKind::left_parenthesis) ++depth;
    if (token.kind == TokenKind::right_parenthesis) {
      --depth;
      std::erase_if(loop_indices, [&](const LoopIndex& index) { return index.depth > depth; });
    }
    if (token.kind != TokenKind::name || constants.find(token.text) != nullptr) continue;
    if ((&token)[1].kind == TokenKind::left_parenthesis) {
      const bool is_loop = token.text == "sum" || token.text == "prod";
      if (is_loop && (&token)[2].kind == TokenKind::name)
        loop_indices.push_back({(&token)[2].text, depth + 1});
      continue;
    }
    if (std::any_of(loop_indices.begin(), loop_indices.end(),
                    [&](const LoopIndex& index) { return index.name == token.text; }))
      continue;
    std::string name(token.text);
    if (after_indices(&token).kind == TokenKind::prime) name += "'";
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

}  // namespace courant
