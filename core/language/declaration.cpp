#include "courant/core/language/declaration.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>
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

std::optional<SymbolTable> symbols_of_elements(const std::vector<std::string>& names,
                                               const ExprVector& values) {
  struct Array {
    Shape shape;
    std::vector<std::pair<std::vector<Index>, Expr>> elements = {};
  };
  std::map<std::pair<std::string, bool>, Array> arrays;  // by name, and whether it is a velocity
  try {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const Reference reference = parse_reference(names[i]);
      Array& array = arrays[{reference.name, reference.is_velocity}];
      array.shape.resize(std::max(array.shape.size(), reference.indices.size()), 0);
      for (std::size_t k = 0; k < reference.indices.size(); ++k)
        array.shape[k] = std::max(array.shape[k], reference.indices[k] + 1);
      array.elements.emplace_back(reference.indices, values[static_cast<Index>(i)]);
    }
    SymbolTable symbols;
    for (const auto& [name, array] : arrays) {
      ExprVector entries = ExprVector::Constant(element_count(array.shape), Expr(0.0));
      for (const auto& [indices, value] : array.elements) {
        Index place = 0;
        for (std::size_t k = 0; k < indices.size(); ++k)
          place = place * array.shape[k] + indices[k];
        entries[place] = value;
      }
      if (name.second)
        symbols.add_velocity(name.first, array.shape, entries);
      else
        symbols.add(name.first, array.shape, entries);
    }
    return symbols;
  } catch (const FormulaError&) {
    return std::nullopt;
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

}  // namespace courant
