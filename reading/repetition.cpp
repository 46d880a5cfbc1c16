#include "courant/reading/repetition.hpp"

#include <cmath>

#include "courant/core/language/declaration.hpp"
#include "courant/core/language/formula.hpp"
#include "courant/core/words/message.hpp"
#include "courant/reading/written_formula.hpp"

namespace courant {
namespace {

constexpr std::size_t kMostTurns = 1000000;
// Beyond it, not every integer is a double.
constexpr double kLargestInteger = 9007199254740992.0;

bool is_integer(double value) {
  return value == std::floor(value) && std::abs(value) <= kLargestInteger;
}

// A bound of an index; nothing, and a problem, if it is no integer.
std::optional<Index> read_bound(const JsonReader& bound, const SymbolTable& constants) {
  const auto formula = read_formula(bound);
  if (!formula) return std::nullopt;
  const auto value = evaluate_constants({{}, {*formula}}, constants, bound.findings());
  if (!value) return std::nullopt;
  if (is_integer((*value)[0])) return static_cast<Index>((*value)[0]);
  bound.problem("is " + number_text((*value)[0]) + "; expected an integer");
  return std::nullopt;
}

}  // namespace

std::optional<std::string> Repetition::Turn::filled(const std::string& text,
                                                    const std::string& pointer,
                                                    Findings& findings) const {
  const auto problem = [&](const std::string& what) {
    findings.problem(pointer, in_quotes(text) + ": " + what);
    return std::nullopt;
  };
  std::string result;
  for (std::size_t at = 0;;) {
    const std::size_t brace = text.find_first_of("{}", at);
    result += text.substr(at, brace - at);
    if (brace == std::string::npos) return result;
    const std::size_t end = text.find_first_of("{}", brace + 1);
    if (text[brace] == '}' || end == std::string::npos || text[end] == '{')
      return problem("a brace has no other one; expected {…} around a formula of the indices");
    const std::string formula = text.substr(brace + 1, end - brace - 1);
    try {
      const Expr value = parse_formula(formula, symbols_);
      if (!is_integer(value.value()) || value.value() < 0.0)
        return problem("{" + formula + "} is " + number_text(value.value()) +
                       "; expected an integer from 0 (other values stand outside of braces: "
                       "\"({i} - 3)/2\")");
      result += std::to_string(static_cast<Index>(value.value()));
    } catch (const FormulaError& error) {
      return problem("in {" + formula + "}, " + error.what());
    }
    at = end + 1;
  }
}

Json Repetition::Turn::filled(const JsonReader& pattern) const {
  const Json& value = pattern.value();
  if (value.is_string())
    return filled(value.get_ref<const std::string&>(), pattern.pointer(), pattern.findings())
        .value_or("");
  if (value.is_array()) {
    Json result = Json::array();
    const auto elements = pattern.elements();
    for (const JsonReader& entry : *elements) result.push_back(filled(entry));
    return result;
  }
  if (!value.is_object()) return value;
  Json result = Json::object();
  auto& entries = static_cast<Json::object_t::Container&>(result.get_ref<Json::object_t&>());
  const auto members = pattern.entries();
  for (const auto& [key, entry] : *members)
    if (key != "repeat") entries.emplace_back(key, filled(entry));
  return result;
}

std::optional<Repetition> Repetition::read(const JsonReader& repeat, const SymbolTable& constants) {
  const auto entries = repeat.entries();
  if (!entries) return std::nullopt;
  if (entries->empty()) {
    repeat.problem("has no index; expected such as {\"i\": [1, \"n\"]}");
    return std::nullopt;
  }
  Repetition repetition(constants, {});
  repetition.turns_ = {{}};
  SymbolTable taken = constants;
  for (const auto& [name, range] : *entries) {
    try {
      if (!parse_declaration(name, taken).shape.empty())
        throw FormulaError(1, in_quotes(name) + " has a size; expected a name");
    } catch (const FormulaError& error) {
      range.problem(std::string("key, ") + error.what());
      return std::nullopt;
    }
    const auto bounds = range.elements();
    if (!bounds) return std::nullopt;
    if (bounds->size() != 2) {
      range.expected("[first, last]");
      return std::nullopt;
    }
    std::vector<std::vector<Index>> turns;
    for (const std::vector<Index>& before : repetition.turns_) {
      const SymbolTable known = repetition.symbols(before);
      const auto first = read_bound((*bounds)[0], known), last = read_bound((*bounds)[1], known);
      if (!first || !last) return std::nullopt;
      const auto count = static_cast<std::size_t>(std::max<Index>(*last - *first + 1, 0));
      if (*last < *first - 1 || count > kMostTurns - turns.size()) {
        range.problem("goes from " + std::to_string(*first) + " to " + std::to_string(*last) +
                      (*last < *first ? "; expected a last value that is not less than the first"
                                      : "; expected at most 1e6 repetitions in all"));
        return std::nullopt;
      }
      for (Index value = *first; value <= *last; ++value) {
        turns.push_back(before);
        turns.back().push_back(value);
      }
    }
    repetition.turns_ = std::move(turns);
    repetition.names_.push_back(name);
    taken.add(name, 0.0);
  }
  return repetition;
}

SymbolTable Repetition::symbols(const std::vector<Index>& turn) const {
  SymbolTable symbols = constants_;
  for (std::size_t i = 0; i < names_.size(); ++i)
    symbols.add(names_[i], static_cast<double>(turn[i]));
  return symbols;
}

bool Repetition::for_each(Findings& findings, const Read& read) const {
  bool is_first = true;
  for (const std::vector<Index>& turn : turns_) {
    std::string words;
    for (std::size_t i = 0; i < names_.size(); ++i)
      words += (i == 0 ? "" : ", ") + names_[i] + " = " + std::to_string(turn[i]);
    Findings own;
    read(Turn(symbols(turn), words), own);
    if (is_first) findings.take_defaults(own);
    is_first = false;
    findings.take_problems(own, " (" + words + ")");
    if (!own.clean()) return false;
  }
  return true;
}

}  // namespace courant
