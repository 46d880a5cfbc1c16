#include "courant/reading/netlist_text.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "courant/core/language/formula.hpp"
#include "courant/core/words/message.hpp"

namespace courant::netlist {
namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return result;
}

bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }

std::vector<std::string> words_of(const std::string& text, int line) {
  std::vector<std::string> words;
  std::string word;
  const auto finish = [&] {
    if (!word.empty()) words.push_back(word);
    word.clear();
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '{' || c == '\'') {
      finish();
      const std::size_t end = text.find(c == '{' ? '}' : '\'', i + 1);
      if (end == std::string::npos)
        throw LineError{line, std::string("an expression begins with ") + c + " and does not end"};
      words.push_back("{" + text.substr(i + 1, end - i - 1) + "}");
      i = end;
    } else if (is_space(c) || c == '(' || c == ')' || c == ',') {
      finish();
    } else if (c == '=') {
      finish();
      words.emplace_back("=");
    } else {
      word += c;
    }
  }
  finish();
  return words;
}

// The number at the start of a text, and how many characters it takes, with the letters behind it.
std::optional<std::pair<double, std::size_t>> leading_number(std::string_view text) {
  double value = 0.0;
  const bool plus = !text.empty() && text[0] == '+';
  const char* begin = text.data() + (plus ? 1 : 0);
  const char* end = text.data() + text.size();
  if (begin == end || !(is_digit(*begin) || *begin == '.' || *begin == '-')) return std::nullopt;
  const auto [after, error] = std::from_chars(begin, end, value);
  if (error != std::errc()) return std::nullopt;
  auto length = static_cast<std::size_t>(after - text.data());
  std::size_t letters = length;
  while (letters < text.size() && is_letter(text[letters])) ++letters;
  const std::string unit = lower(text.substr(length, letters - length));
  const auto is = [&](const char* prefix) { return unit.rfind(prefix, 0) == 0; };
  if (is("mil")) return std::pair(value * 25.4e-6, letters);
  const char* exponent = is("meg") ? "e6"
                         : is("t") ? "e12"
                         : is("g") ? "e9"
                         : is("k") ? "e3"
                         : is("m") ? "e-3"
                         : is("u") ? "e-6"
                         : is("n") ? "e-9"
                         : is("p") ? "e-12"
                         : is("f") ? "e-15"
                                   : "";
  // As one decimal number: 100 times the double 1e-9 is not 1e-7.
  const std::string_view digits(begin, static_cast<std::size_t>(after - begin));
  const double factor = std::stod(std::string("1") + exponent);
  if (digits.find_first_of("eE") != std::string_view::npos)
    return std::pair(value * factor, letters);
  const std::string whole = std::string(digits) + exponent;
  std::from_chars(whole.data(), whole.data() + whole.size(), value);
  return std::pair(value, letters);
}

}  // namespace

std::vector<Line> lines_of(std::string_view text, std::string& title) {
  struct Joined {
    int number;
    std::string text;
  };
  std::vector<Joined> joined;
  int number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    std::size_t end = text.find('\n', begin);
    if (end == std::string_view::npos) end = text.size();
    std::string line(text.substr(begin, end - begin));
    begin = end + 1;
    ++number;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (number == 1) {
      title = line;
      continue;
    }
    const std::size_t comment = std::min(line.find(';'), line.find("$ "));
    if (comment != std::string::npos) line.resize(comment);
    const std::size_t first = line.find_first_not_of(" \t");
    if (first == std::string::npos || line[first] == '*') continue;
    if (line[first] == '+') {
      if (joined.empty()) throw LineError{number, "continues no line"};
      joined.back().text += " " + line.substr(first + 1);
    } else {
      joined.push_back({number, line});
    }
  }
  std::vector<Line> lines;
  for (const auto& [where, content] : joined) {
    Line line{where, {}, words_of(content, where)};
    for (const std::string& word : line.written) line.words.push_back(lower(word));
    if (!line.words.empty() && line.words[0] == ".end") break;
    if (!line.words.empty()) lines.push_back(std::move(line));
  }
  return lines;
}

std::optional<double> number(std::string_view word) {
  const auto found = leading_number(word);
  return found && found->second == word.size() ? std::optional(found->first) : std::nullopt;
}

namespace {

// Throws LineError if the formula, made of the text, is none.
void check_formula(const std::string& formula, const std::string& text, const Scope& scope,
                   int line) {
  SymbolTable symbols;
  for (const auto& [name, global] : scope)
    if (!symbols.find(global) && !number(global)) symbols.add(global, 1.0);
  try {
    parse_formula(formula, symbols);
  } catch (const FormulaError& error) {
    const std::string what = error.what();  // column 7: …, of another text
    throw LineError{line, "\"" + text + "\" is no expression: " + what.substr(what.find(": ") + 2)};
  }
}

}  // namespace

std::string formula(const std::string& word, const Scope& scope, int line) {
  if (const auto value = number(word)) return exact_text(*value);
  const bool braces = word.front() == '{';
  const std::string text = braces ? word.substr(1, word.size() - 2) : word;
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const std::string_view rest = std::string_view(text).substr(i);
    if (is_digit(text[i]) || text[i] == '.') {
      const auto found = leading_number(rest);
      if (!found) throw LineError{line, "\"" + text + "\" has no number where one begins"};
      result += exact_text(found->first);
      i += found->second;
    } else if (is_letter(text[i])) {
      std::size_t end = i;
      while (end < text.size() && (is_letter(text[end]) || is_digit(text[end]))) ++end;
      const std::string name = text.substr(i, end - i);
      const std::size_t next = text.find_first_not_of(' ', end);
      const bool is_function = next != std::string::npos && text[next] == '(';
      if (const auto known = scope.find(name); known != scope.end())
        result += known->second;
      else if (is_function || name == "pi")
        result += name == "ln" ? "log" : name;
      else
        throw LineError{line, "unknown parameter \"" + name + "\""};
      i = end;
    } else if (rest.substr(0, 2) == "**") {
      result += "^";
      i += 2;
    } else {
      result += text[i++];
    }
  }
  check_formula(result, text, scope, line);
  return braces ? "(" + result + ")" : result;
}

}  // namespace courant::netlist
