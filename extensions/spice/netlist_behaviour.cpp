#include "courant/extensions/spice/netlist_behaviour.hpp"

#include <algorithm>
#include <cctype>
#include <map>

#include "courant/core/language/formula.hpp"
#include "courant/core/words/message.hpp"

namespace courant::netlist {
namespace {

bool is_letter_of_name(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
}
bool is_digit_of_number(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

class Translation {
 public:
  Translation(const Scope& scope, int line, const BehaviourWords& words)
      : scope_(scope), line_(line), words_(words) {}

  // With `c ? a : b` at the top, or without.
  std::string whole(const std::string& written) const {
    const std::size_t first = written.find_first_not_of(" \t"),
                      last = written.find_last_not_of(" \t");
    const std::string text =
        first == std::string::npos ? "" : written.substr(first, last - first + 1);
    const auto [question, colon] = choice(text);
    if (question == std::string::npos) return plain(text);
    return "if(" + whole(text.substr(0, question)) + ", " +
           whole(text.substr(question + 1, colon - question - 1)) + ", " +
           whole(text.substr(colon + 1)) + ")";
  }

 private:
  // Where the outermost ? and its : are.
  std::pair<std::size_t, std::size_t> choice(const std::string& text) const {
    std::size_t question = std::string::npos;
    int depth = 0, open = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
      const char c = text[i];
      if (c == '(' || c == '{') ++depth;
      if (c == ')' || c == '}') --depth;
      if (depth > 0) continue;
      if (c == '?' && open++ == 0) question = i;
      if (c == ':' && open > 0 && --open == 0) return {question, i};
    }
    if (question != std::string::npos) throw LineError{line_, "has a ? without its :"};
    return {question, question};
  }

  std::string plain(const std::string& text) const {
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
      const char c = text[i];
      if (is_digit_of_number(c) ||
          (c == '.' && i + 1 < text.size() && is_digit_of_number(text[i + 1]))) {
        std::size_t end = i;
        while (end < text.size() &&
               (is_letter_of_name(text[end]) || is_digit_of_number(text[end]) || text[end] == '.' ||
                ((text[end] == '+' || text[end] == '-') &&
                 (text[end - 1] == 'e' || text[end - 1] == 'E') && end + 1 < text.size() &&
                 is_digit_of_number(text[end + 1]) && is_digit_of_number(text[i]))))
          ++end;
        const auto value = number(text.substr(i, end - i));
        if (!value) throw LineError{line_, "\"" + text.substr(i, end - i) + "\" is no number"};
        result += exact_text(*value);
        i = end;
      } else if (is_letter_of_name(c)) {
        std::size_t end = i;
        while (end < text.size() && (is_letter_of_name(text[end]) || is_digit_of_number(text[end])))
          ++end;
        const std::string name = lowered(text.substr(i, end - i));
        const std::size_t open = text.find_first_not_of(" \t", end);
        if (open != std::string::npos && text[open] == '(') {
          const std::size_t close = closing(text, open);
          result += call(name, text.substr(open + 1, close - open - 1));
          i = close + 1;
        } else {
          result += value_of(name);
          i = end;
        }
      } else if (c == '(' || c == '{') {
        const std::size_t close = closing(text, i);
        result += "(" + whole(text.substr(i + 1, close - i - 1)) + ")";
        i = close + 1;
      } else if (text.compare(i, 2, "**") == 0) {
        result += "^";
        i += 2;
      } else if (c == '&' || c == '|') {
        result += std::string(2, c);
        i += text.compare(i, 2, std::string(2, c)) == 0 ? 2 : 1;
      } else if (c == '\'' || c == '"') {
        ++i;
      } else {
        result += c;
        ++i;
      }
    }
    return result;
  }

  std::size_t closing(const std::string& text, std::size_t open) const {
    int depth = 0;
    for (std::size_t i = open; i < text.size(); ++i) {
      if (text[i] == '(' || text[i] == '{') ++depth;
      if ((text[i] == ')' || text[i] == '}') && --depth == 0) return i;
    }
    throw LineError{line_, "has a ( without its )"};
  }

  static std::string lowered(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
  }

  std::string value_of(const std::string& name) const {
    if (const auto known = scope_.find(name); known != scope_.end()) return known->second;
    if (name == "time") return "t";
    if (name == "pi" || name == "e") return name;
    if (name == "temper") return "27";
    throw LineError{line_, "unknown parameter \"" + name + "\""};
  }

  static std::vector<std::string> arguments(const std::string& text) {
    std::vector<std::string> result(1);
    int depth = 0;
    for (const char c : text) {
      if (c == '(' || c == '{') ++depth;
      if (c == ')' || c == '}') --depth;
      if (c == ',' && depth == 0)
        result.emplace_back();
      else
        result.back() += c;
    }
    return result;
  }

  static std::string without_spaces(std::string text) {
    std::erase_if(text, [](unsigned char c) { return std::isspace(c) != 0; });
    return lowered(text);
  }

  std::string call(const std::string& name, const std::string& inside) const {
    const std::vector<std::string> written = arguments(inside);
    if (name == "v") {
      const std::string first = words_.potential(without_spaces(written[0]));
      if (written.size() == 1) return first;
      return "(" + first + " - " + words_.potential(without_spaces(written[1])) + ")";
    }
    if (name == "i") return words_.current(without_spaces(written[0]));
    std::vector<std::string> values;
    for (const std::string& argument : written) values.push_back(whole(argument));
    const auto needs = [&](std::size_t count) {
      if (values.size() != count)
        throw LineError{line_, "the function " + name + " has " + std::to_string(values.size()) +
                                   " arguments; expected " + std::to_string(count)};
    };
    static const std::map<std::string, std::string> same = {
        {"abs", "abs"},   {"acos", "acos"}, {"asin", "asin"}, {"atan", "atan"},
        {"cos", "cos"},   {"cosh", "cosh"}, {"exp", "exp"},   {"ln", "log"},
        {"log", "log"},   {"sgn", "sign"},  {"sin", "sin"},   {"sinh", "sinh"},
        {"sqrt", "sqrt"}, {"tan", "tan"},   {"tanh", "tanh"}, {"arctan", "atan"}};
    if (const auto found = same.find(name); found != same.end()) {
      needs(1);
      return found->second + "(" + values[0] + ")";
    }
    if (name == "asinh")
      return needs(1), "log(" + values[0] + " + sqrt((" + values[0] + ")^2 + 1))";
    if (name == "acosh")
      return needs(1), "log(" + values[0] + " + sqrt((" + values[0] + ")^2 - 1))";
    if (name == "atanh")
      return needs(1), "(log((1 + " + values[0] + ")/(1 - (" + values[0] + ")))/2)";
    if (name == "log10") return needs(1), "(log(" + values[0] + ")/log(10))";
    if (name == "u" || name == "stp") return needs(1), "if(" + values[0] + " > 0, 1, 0)";
    if (name == "u2") return needs(1), "min(max(" + values[0] + ", 0), 1)";
    if (name == "uramp") return needs(1), "max(" + values[0] + ", 0)";
    if (name == "atan2") return needs(2), "atan2(" + values[0] + ", " + values[1] + ")";
    if (name == "min" || name == "max") {
      if (values.size() == 1) return "(" + values[0] + ")";
      std::string list = values[0];
      for (std::size_t k = 1; k < values.size(); ++k) list += ", " + values[k];
      return name + "(" + list + ")";
    }
    if (name == "pow" || name == "pwrs") return needs(2), "(" + values[0] + ")^(" + values[1] + ")";
    if (name == "pwr")
      return needs(2), "(sign(" + values[0] + ")*abs(" + values[0] + ")^(" + values[1] + "))";
    if (name == "limit") {
      needs(3);
      return "min(max(" + values[0] + ", " + values[1] + "), " + values[2] + ")";
    }
    if (name == "if" || name == "ternary_fcn") {
      needs(3);
      return "if(" + values[0] + ", " + values[1] + ", " + values[2] + ")";
    }
    if (name == "pwl" || name == "table") return table(values);
    if (name == "ddt" && words_.derivative) return needs(1), words_.derivative(values[0]);
    throw LineError{line_, "the function " + name + " is not supported"};
  }

  // y₁ + Σ slope (min(max(x, x_k), x_{k+1}) - x_k)
  std::string table(const std::vector<std::string>& values) const {
    if (values.size() < 5 || values.size() % 2 == 0)
      throw LineError{line_,
                      "a table has an argument and pairs of numbers; expected two pairs or more"};
    std::string sum = "(" + values[2];
    for (std::size_t k = 1; k + 3 < values.size(); k += 2)
      sum += " + (" + values[k + 3] + " - (" + values[k + 1] + "))*(min(max(" + values[0] + ", " +
             values[k] + "), " + values[k + 2] + ") - (" + values[k] + "))/(" + values[k + 2] +
             " - (" + values[k] + "))";
    return sum + ")";
  }

  const Scope& scope_;
  int line_;
  const BehaviourWords& words_;
};

}  // namespace

std::string behaviour(const std::string& expression, const Scope& scope, int line,
                      const BehaviourWords& words) {
  return Translation(scope, line, words).whole(expression);
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
  const BehaviourWords none{
      [&](const std::string& node) -> std::string {
        throw LineError{line, "\"" + word + "\" asks for v(" + node + "); expected a constant"};
      },
      [&](const std::string& source) -> std::string {
        throw LineError{line, "\"" + word + "\" asks for i(" + source + "); expected a constant"};
      }};
  const bool braces = word.front() == '{';
  const std::string text = braces ? word.substr(1, word.size() - 2) : word;
  const std::string result = behaviour(text, scope, line, none);
  check_formula(result, text, scope, line);
  return braces ? "(" + result + ")" : result;
}

std::string polynomial(const std::vector<std::string>& controls,
                       const std::vector<std::string>& coefficients, int line) {
  const std::size_t n = controls.size();
  if (coefficients.size() == 1 && n == 1) return coefficients[0] + "*" + controls[0];
  std::vector<std::string> terms = {""};
  for (std::size_t i = 0; i < n; ++i) terms.push_back(controls[i]);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i; j < n; ++j) terms.push_back(controls[i] + "*" + controls[j]);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i; j < n; ++j)
      for (std::size_t k = j; k < n; ++k)
        terms.push_back(controls[i] + "*" + controls[j] + "*" + controls[k]);
  if (coefficients.size() > terms.size())
    throw LineError{line, "POLY(" + std::to_string(n) + ") has " +
                              std::to_string(coefficients.size()) +
                              " coefficients; expected at most " + std::to_string(terms.size()) +
                              ", those of the third order"};
  std::string sum;
  for (std::size_t k = 0; k < coefficients.size(); ++k) {
    if (number(coefficients[k]) == std::optional(0.0)) continue;
    sum += (sum.empty() ? "" : " + ") + coefficients[k] + (terms[k].empty() ? "" : "*" + terms[k]);
  }
  return sum.empty() ? "0" : sum;
}

}  // namespace courant::netlist
