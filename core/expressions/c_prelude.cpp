#include "courant/core/expressions/c_prelude.hpp"

#include <string_view>

#include "courant/core/numbers/special_functions.hpp"

namespace courant {
namespace {

constexpr const char* kPowerInC =
    "static double courant_power(int k, double base) {\n"
    "  unsigned exponent = k < 0 ? 0u - (unsigned)k : (unsigned)k;\n"
    "  double result = 1.0;\n"
    "  int first = 1;\n"
    "  while (exponent) {\n"
    "    if (exponent & 1u) {\n"
    "      result = first ? base : result * base;\n"
    "      first = 0;\n"
    "    }\n"
    "    exponent >>= 1;\n"
    "    if (exponent) base = base * base;\n"
    "  }\n"
    "  return k < 0 ? 1.0 / result : result;\n"
    "}\n";

// A statement a line: the text of special_functions is one line.
std::string in_lines(std::string_view source) {
  std::string text, indent;
  int brackets = 0;
  const auto next_line = [&] { text += "\n" + indent; };
  for (std::size_t i = 0; i < source.size(); ++i) {
    const char c = source[i];
    if (c == ' ' && (text.empty() || text.back() == '\n' || text.ends_with("\n" + indent)))
      continue;
    if (c == '}') {
      indent.resize(indent.size() - 2);
      text.resize(text.find_last_not_of(' ') + 1);
      text += indent;
    }
    text += c;
    if (c == '(') ++brackets;
    if (c == ')') --brackets;
    if (c == '{') indent += "  ";
    if (c == '{' || c == '}' || (c == ';' && brackets == 0)) next_line();
  }
  return text;
}

}  // namespace

std::string c_prelude(const std::string& source) {
  const auto calls = [&](const char* name) { return source.find(name) != std::string::npos; };
  std::string prelude = "#include <math.h>\n\n";
  const std::string_view special = special_functions_source();
  const std::size_t second = special.find("static double courant_arccos_factor(");
  if (calls("courant_stumpff(")) prelude += in_lines(special.substr(0, second)) + "\n";
  if (calls("courant_arccos_factor(")) prelude += in_lines(special.substr(second)) + "\n";
  if (calls("courant_power(")) prelude += std::string(kPowerInC) + "\n";
  return prelude;
}

}  // namespace courant
