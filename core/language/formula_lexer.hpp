// The words of the formula language.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace courant::formula {

// What a token of a formula is.
enum class TokenKind : std::uint8_t {
  end,
  number,
  name,
  plus,
  minus,
  times,
  over,
  hat,
  less,
  less_equal,
  greater,
  greater_equal,
  equal,
  unequal,
  logical_and,
  logical_or,
  logical_not,
  left_parenthesis,
  right_parenthesis,
  left_bracket,
  right_bracket,
  comma,
  prime,
};

// A word of a formula: `text` is a view into the formula, `column` as in FormulaError.
struct Token {
  TokenKind kind;
  std::size_t column;
  std::string_view text;
  double number = 0;  // of TokenKind::number
};

// The words of `text`, the last one of TokenKind::end and empty. Numbers are decimal whatever the
// locale is; a name is a letter or _ (Latin, Greek or Cyrillic) and then letters, digits and _.
// Throws FormulaError.
std::vector<Token> tokenize(std::string_view text);

// How tightly a sign binds what stands on both sides; 0 if it is no such sign. ^ does so to the right.
int binding_of(TokenKind kind);
// The same of a sign before its operand.
inline constexpr int kUnary = 6;

// Whether `text` is one name and nothing else.
bool is_name(std::string_view text);

}  // namespace courant::formula
