#include "courant/core/language/formula_lexer.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <system_error>

#include "courant/core/language/formula_error.hpp"

namespace courant::formula {
namespace {

constexpr std::size_t kLongestFormula = 1'000'000;  // characters; a typing error beyond this

struct Spelling {
  std::string_view text;
  TokenKind kind;
  std::string_view meant = {};  // for what people write, or paste from a paper, instead
};

// A symbol stands before its beginnings.
constexpr std::array kSpellings{
    Spelling{"<=", TokenKind::less_equal},
    Spelling{">=", TokenKind::greater_equal},
    Spelling{"==", TokenKind::equal},
    Spelling{"!=", TokenKind::unequal},
    Spelling{"&&", TokenKind::logical_and},
    Spelling{"||", TokenKind::logical_or},
    Spelling{"**", TokenKind::end, "^"},
    Spelling{"+", TokenKind::plus},
    Spelling{"-", TokenKind::minus},
    Spelling{"*", TokenKind::times},
    Spelling{"/", TokenKind::over},
    Spelling{"^", TokenKind::hat},
    Spelling{"<", TokenKind::less},
    Spelling{">", TokenKind::greater},
    Spelling{"!", TokenKind::logical_not},
    Spelling{"(", TokenKind::left_parenthesis},
    Spelling{")", TokenKind::right_parenthesis},
    Spelling{"[", TokenKind::left_bracket},
    Spelling{"]", TokenKind::right_bracket},
    Spelling{",", TokenKind::comma},
    Spelling{"'", TokenKind::prime},
    Spelling{"=", TokenKind::end, "=="},
    Spelling{"&", TokenKind::end, "&&"},
    Spelling{"|", TokenKind::end, "||"},
    Spelling{"−", TokenKind::end, "-"},
    Spelling{"·", TokenKind::end, "*"},
    Spelling{"×", TokenKind::end, "*"},
    Spelling{"÷", TokenKind::end, "/"},
    Spelling{"²", TokenKind::end, "^2"},
    Spelling{"³", TokenKind::end, "^3"},
    Spelling{"≤", TokenKind::end, "<="},
    Spelling{"≥", TokenKind::end, ">="},
    Spelling{"≠", TokenKind::end, "!="},
    Spelling{"’", TokenKind::end, "'"},
    Spelling{"′", TokenKind::end, "'"},
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

// Bytes of the UTF-8 character that `text` begins with, 0 if it begins with none.
std::size_t character_length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text.front());
  const std::size_t length = lead < 0x80   ? 1
                             : lead < 0xC2 ? 0
                             : lead < 0xE0 ? 2
                             : lead < 0xF0 ? 3
                             : lead < 0xF5 ? 4
                                           : 0;
  if (length > text.size()) return 0;
  return std::all_of(text.begin() + 1, text.begin() + static_cast<std::ptrdiff_t>(length),
                     is_continuation)
             ? length
             : 0;
}

// Bytes of the letter that `text` begins with, 0 if it begins with none.
std::size_t letter_length(std::string_view text) {
  if (text.empty()) return 0;
  const char c = text.front();
  if ((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_') return 1;
  if (character_length(text) != 2) return 0;
  const unsigned code =
      (static_cast<unsigned char>(c) & 0x1FU) << 6U | (static_cast<unsigned char>(text[1]) & 0x3FU);
  const bool latin = code >= 0xC0 && code <= 0x24F && code != 0xD7 && code != 0xF7;  // not × and ÷
  const bool greek_or_cyrillic = code >= 0x370 && code <= 0x52F;
  return latin || greek_or_cyrillic ? 2 : 0;
}

// Bytes of the name that `text` begins with, 0 if it begins with none. A point between letters belongs to it: crank.tip.x.
std::size_t name_length(std::string_view text) {
  std::size_t length = letter_length(text);
  while (length != 0 && length < text.size()) {
    const std::string_view rest = text.substr(length);
    std::size_t more = is_digit(rest.front()) ? 1 : letter_length(rest);
    if (rest.front() == '.')
      if (const std::size_t letter = letter_length(rest.substr(1)); letter != 0) more = 1 + letter;
    if (more == 0) break;
    length += more;
  }
  return length;
}

bool begins_number(std::string_view text) {
  return is_digit(text[0]) || (text[0] == '.' && text.size() > 1 && is_digit(text[1]));
}

Token number_token(std::string_view text, std::size_t column) {
  Token token{TokenKind::number, column, {}};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), token.number);
  token.text = text.substr(0, static_cast<std::size_t>(end - text.data()));
  if (error == std::errc::result_out_of_range)
    throw FormulaError(column, "number " + std::string(token.text.substr(0, 40)) +
                                   " is outside the range of double precision");
  return token;
}

[[noreturn]] void refuse_character(std::string_view text, std::size_t column) {
  const auto byte = static_cast<unsigned char>(text.front());
  const std::size_t length = character_length(text);
  if (length == 0 || byte < 0x20 || byte == 0x7F) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    throw FormulaError(column,
                       std::string("unexpected byte 0x") + kDigits[byte / 16] + kDigits[byte % 16]);
  }
  throw FormulaError(column, "unexpected \"" + std::string(text.substr(0, length)) + "\"");
}

Token symbol_token(std::string_view text, std::size_t column) {
  for (const Spelling& symbol : kSpellings) {
    if (!text.starts_with(symbol.text)) continue;
    if (!symbol.meant.empty())
      throw FormulaError(column, "unexpected \"" + std::string(symbol.text) +
                                     "\" (did you mean \"" + std::string(symbol.meant) + "\"?)");
    return {symbol.kind, column, text.substr(0, symbol.text.size())};
  }
  refuse_character(text, column);
}

Token first_token(std::string_view text, std::size_t column) {
  if (begins_number(text)) return number_token(text, column);
  if (const std::size_t length = name_length(text); length != 0)
    return {TokenKind::name, column, text.substr(0, length)};
  return symbol_token(text, column);
}

}  // namespace

std::vector<Token> tokenize(std::string_view text) {
  if (text.size() > kLongestFormula)
    throw FormulaError(1, "formula has " + std::to_string(text.size()) +
                              " bytes; expected at most " + std::to_string(kLongestFormula));
  std::vector<Token> tokens;
  std::size_t column = 1;
  while (!text.empty()) {
    std::size_t length = 1;
    if (!is_space(text.front())) {
      tokens.push_back(first_token(text, column));
      length = tokens.back().text.size();
    }
    const std::string_view passed = text.substr(0, length);
    column += length - static_cast<std::size_t>(
                           std::count_if(passed.begin(), passed.end(), is_continuation));
    text.remove_prefix(length);
  }
  tokens.push_back({TokenKind::end, column, text});
  return tokens;
}

int binding_of(TokenKind kind) {
  switch (kind) {
    case TokenKind::logical_or:
      return 1;
    case TokenKind::logical_and:
      return 2;
    case TokenKind::less:
    case TokenKind::less_equal:
    case TokenKind::greater:
    case TokenKind::greater_equal:
    case TokenKind::equal:
    case TokenKind::unequal:
      return 3;
    case TokenKind::plus:
    case TokenKind::minus:
      return 4;
    case TokenKind::times:
    case TokenKind::over:
      return 5;
    case TokenKind::hat:
      return 7;
    default:
      return 0;
  }
}

bool is_name(std::string_view text) { return !text.empty() && name_length(text) == text.size(); }

}  // namespace courant::formula
