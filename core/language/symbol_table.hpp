// SymbolTable: what the names in a formula stand for.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "courant/core/expressions/expr.hpp"

namespace courant {

// {} a number, {n} an array, {n, m} an array of n rows of m.
using Shape = std::vector<Index>;

// Number of elements: the product of the extents, 1 for a number.
Index element_count(const Shape& shape);

// A named number or array; values in row-major order: element (i, j) is values[i*m + j].
struct Symbol {
  Shape shape;
  ExprVector values;
};

// Names and their values: coordinates and definitions (nodes of one graph), parameters (constants).
//
// `x` and its velocity `x'` are two entries, which need not have one shape. `pi` and `e` are always
// there; the names of functions (sin, sum, if, …) are never free. Integers in formulas (indices,
// the bounds of sums) are made of whatever is constant here.
class SymbolTable {
 public:
  SymbolTable();

  // Throw std::invalid_argument if `name` is not a name or is taken, or the shape (at most two
  // extents, each at least 1) does not fit the values.
  void add(const std::string& name, const Expr& value);
  void add(const std::string& name, const Shape& shape, const ExprVector& values);
  void add_velocity(const std::string& name, const Expr& value);
  void add_velocity(const std::string& name, const Shape& shape, const ExprVector& values);

  // Null if there is none.
  const Symbol* find(std::string_view name) const;
  const Symbol* find_velocity(std::string_view name) const;

  // Without velocities, in alphabetical order.
  std::vector<std::string> names() const;

 private:
  using Symbols = std::map<std::string, Symbol, std::less<>>;

  Symbols symbols_;
  Symbols velocities_;
};

}  // namespace courant
