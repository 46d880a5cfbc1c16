#include "courant/core/words/message.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace courant {
namespace {

template <class... Format>
std::string written(double value, Format... format) {
  if (std::isnan(value)) return "nan";  // whatever its sign
  char buffer[400];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value, format...).ptr};
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

// Whether the text before a colon is a place in the code: Class::function, Class(parameters), or
// the plain name of a function.
bool is_place(std::string_view head) {
  bool names_only = true, has_parameters = false;
  int depth = 0;
  for (const char c : head) {
    if (c == '(') has_parameters = true;
    if (c == '(' || c == '[') ++depth;
    if (c == ' ' && depth == 0) return false;
    if (c == ')' || c == ']') --depth;
    names_only = names_only && is_letter(c);
  }
  return depth == 0 && !head.empty() && is_letter(head.front()) &&
         (names_only || has_parameters || head.find("::") != std::string_view::npos);
}

struct Letter {
  std::optional<unsigned> code;  // none of bytes that are not UTF-8
  std::size_t bytes = 1;
};

// The letter that a text begins with, in UTF-8 of at most three bytes.
Letter first_letter(std::string_view text) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
  };
  const auto goes_on = [&](std::size_t i) { return (byte(i) & 0xC0) == 0x80; };
  if (byte(0) < 0x80) return {byte(0), 1};
  if ((byte(0) & 0xE0) == 0xC0 && goes_on(1)) return {(byte(0) & 0x1F) << 6 | (byte(1) & 0x3F), 2};
  if ((byte(0) & 0xF0) == 0xE0 && goes_on(1) && goes_on(2))
    return {(byte(0) & 0xF) << 12 | (byte(1) & 0x3F) << 6 | (byte(2) & 0x3F), 3};
  return {};
}

// Whether a terminal obeys a letter in the place of showing it: control characters; separators of lines and
// paragraphs; and marks that turn the direction of the text, behind which a line reads as another one.
bool is_obeyed(unsigned code) {
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x61C || code == 0x200E ||
         code == 0x200F || (code >= 0x2028 && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
}

}  // namespace

std::string number_text(double value, int digits) {
  return written(value, std::chars_format::general, digits);
}

std::string exact_text(double value) { return written(value); }

std::string without_place(std::string_view message) {
  for (std::size_t colon = message.find(": "); colon != std::string_view::npos;
       colon = message.find(": ", colon + 1))
    if (is_place(message.substr(0, colon)))
      return without_place(message.substr(colon + 2));  // one function may pass on another's words
  return std::string(message);
}

std::string printable(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const auto [code, bytes] = first_letter(text);
    if (code && is_obeyed(*code)) {
      result += "\\u";
      for (const int bits : {12, 8, 4, 0}) result += "0123456789abcdef"[*code >> bits & 0xF];
    } else {
      result += text.substr(0, bytes);
    }
    text.remove_prefix(bytes);
  }
  return result;
}

std::string in_quotes(std::string_view text) { return '"' + std::string(text) + '"'; }

std::string size_text(std::ptrdiff_t rows, std::ptrdiff_t columns) {
  return std::to_string(rows) + " × " + std::to_string(columns);
}

}  // namespace courant
