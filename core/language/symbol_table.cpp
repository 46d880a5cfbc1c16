#include "courant/core/language/symbol_table.hpp"

#include <algorithm>
#include <functional>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "courant/core/language/formula_functions.hpp"
#include "courant/core/language/formula_lexer.hpp"

namespace courant {
namespace {

const Symbol* find_in(const std::map<std::string, Symbol, std::less<>>& symbols,
                      std::string_view name) {
  const auto found = symbols.find(name);
  return found == symbols.end() ? nullptr : &found->second;
}

Symbol checked(const std::string& name, const Shape& shape, const ExprVector& values) {
  const auto refuse = [](const std::string& reason) {
    throw std::invalid_argument("SymbolTable::add: " + reason);
  };
  if (!formula::is_name(name))
    refuse("\"" + name + "\" is not a name; expected letters, digits and _, a letter first.");
  if (formula::find_function(name) != nullptr)
    refuse("\"" + name + "\" is the name of a function; expected another.");
  if (shape.size() > 2 || std::any_of(shape.begin(), shape.end(), [](Index n) { return n < 1; }))
    refuse("the shape of \"" + name + "\" is wrong; expected at most 2 extents, each at least 1.");
  if (values.size() != element_count(shape))
    refuse("\"" + name + "\" has " + std::to_string(values.size()) + " values; expected " +
           std::to_string(element_count(shape)) + ".");
  return {shape, values};
}

void insert(std::map<std::string, Symbol, std::less<>>& symbols, const std::string& name,
            const Shape& shape, const ExprVector& values) {
  if (!symbols.try_emplace(name, checked(name, shape, values)).second)
    throw std::invalid_argument("SymbolTable::add: \"" + name + "\" is already there.");
}

}  // namespace

Index element_count(const Shape& shape) {
  return std::accumulate(shape.begin(), shape.end(), Index{1}, std::multiplies<>());
}

SymbolTable::SymbolTable() {
  add("pi", std::numbers::pi);
  add("e", std::numbers::e);
}

void SymbolTable::add(const std::string& name, const Expr& value) {
  add(name, {}, ExprVector::Constant(1, value));
}

void SymbolTable::add(const std::string& name, const Shape& shape, const ExprVector& values) {
  insert(symbols_, name, shape, values);
}

void SymbolTable::add_velocity(const std::string& name, const Expr& value) {
  add_velocity(name, {}, ExprVector::Constant(1, value));
}

void SymbolTable::add_velocity(const std::string& name, const Shape& shape,
                               const ExprVector& values) {
  insert(velocities_, name, shape, values);
}

const Symbol* SymbolTable::find(std::string_view name) const { return find_in(symbols_, name); }

const Symbol* SymbolTable::find_velocity(std::string_view name) const {
  return find_in(velocities_, name);
}

std::vector<std::string> SymbolTable::names() const {
  std::vector<std::string> names;
  for (const auto& [name, symbol] : symbols_) names.push_back(name);
  return names;
}

}  // namespace courant
