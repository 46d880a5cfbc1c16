#include "courant/core/language/declaration.hpp"

#include <utility>

#include "courant/core/language/formula_functions.hpp"
#include "courant/core/language/formula_parser.hpp"

namespace courant {
namespace {

using formula::Parser;
using formula::Token;
using formula::TokenKind;

constexpr Index kMostElements = 10'000'000;  // beyond this an extent is a typing error

// Of a name that has one in every formula: ", Euler's number". Empty for those that an experiment made itself.
std::string meaning_everywhere(std::string_view name) {
  if (name == "e") return ", Euler's number";
  if (name == "pi") return ", the number π";
  return formula::find_function(name) != nullptr ? ", a function" : "";
}

}  // namespace

std::vector<std::string> Declaration::element_names() const {
  std::vector<std::string> names{name};
  for (const Index extent : shape) {
    std::vector<std::string> longer;
    for (const std::string& beginning : names)
      for (Index i = 0; i < extent; ++i)
        longer.push_back(beginning + "[" + std::to_string(i) + "]");
    names = std::move(longer);
  }
  return names;
}

Declaration parse_declaration(std::string_view text, const SymbolTable& known) {
  Parser parser(text, known, "declaration");
  const Token& name = parser.name();
  Declaration declaration{std::string(name.text), {}};
  if (const std::size_t point = name.text.find('.'); point != std::string_view::npos)
    throw FormulaError(name.column + point,
                       "unexpected \".\"; expected a name of letters, digits "
                       "and _");
  if (formula::find_function(name.text) != nullptr || known.find(name.text) != nullptr)
    throw FormulaError(name.column, "\"" + declaration.name + "\" has a meaning already" +
                                        meaning_everywhere(name.text) + "; expected a new name");
  for (const auto& [extent, column] : parser.subscripts("size", name.text)) {
    if (extent < 1 || extent > kMostElements / declaration.size())
      throw FormulaError(column, "size of " + declaration.name + " is " + std::to_string(extent) +
                                     "; expected at least 1, and at most " +
                                     std::to_string(kMostElements) + " elements");
    declaration.shape.push_back(extent);
  }
  parser.end();
  return declaration;
}

Reference parse_reference(std::string_view text) {
  const SymbolTable constants;
  Parser parser(text, constants, "name");
  const Token& name = parser.name();
  Reference reference{std::string(name.text), {}};
  for (const auto& [index, column] : parser.subscripts("index", name.text)) {
    if (index < 0)
      throw FormulaError(column, "index of " + reference.name + " is " + std::to_string(index) +
                                     "; expected at least 0");
    reference.indices.push_back(index);
  }
  reference.is_velocity = parser.accept(TokenKind::prime);
  parser.end();
  return reference;
}

}  // namespace courant
