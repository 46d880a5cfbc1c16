#include "courant/core/words/message.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

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
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    // C1, U+0080 … U+009F, is C2 80 … C2 9F.
    const bool is_c1 =
        c == 0xC2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xA0;
    if (c >= 0x20 && c != 0x7F && !is_c1) {
      result += text[i];
      continue;
    }
    const unsigned code = is_c1 ? static_cast<unsigned char>(text[++i]) : c;
    result += "\\u00";
    result += "0123456789abcdef"[code >> 4];
    result += "0123456789abcdef"[code & 0xF];
  }
  return result;
}

std::string in_quotes(std::string_view text) { return '"' + std::string(text) + '"'; }

std::string size_text(std::ptrdiff_t rows, std::ptrdiff_t columns) {
  return std::to_string(rows) + " × " + std::to_string(columns);
}

}  // namespace courant
