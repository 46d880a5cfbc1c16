// Declarations `r[20][3]` and references `r[3][2]'`: how names and their elements are written.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "courant/core/language/formula_error.hpp"
#include "courant/core/language/symbol_table.hpp"

namespace courant {

// A name with the shape of what it names.
struct Declaration {
  std::string name;
  Shape shape;

  Index size() const { return element_count(shape); }
  // x; r[0], r[1], …; R[0][0], R[0][1], …: in row-major order, each as parse_reference reads it.
  std::vector<std::string> element_names() const;
};

// A name, some indices, and whether its velocity is meant; nothing says that there is such an
// element.
struct Reference {
  std::string name;
  std::vector<Index> indices;
  bool is_velocity = false;
};

// `x`, `r[4]`, `r[n][3]`: the extents are constant integers, at least 1, made of what is in
// `known`; the name must not be there yet. Throws FormulaError.
Declaration parse_declaration(std::string_view text, const SymbolTable& known = SymbolTable());

// `x`, `x[0]`, `r[3][2]`, `x'`, `r[2]'`. Throws FormulaError.
Reference parse_reference(std::string_view text);

// A table in which formulas of these names can be read: x, r[2][1], x', with an array of each r. Elements that nobody
// names are 0. Nothing where one of them is no name of the language.
std::optional<SymbolTable> symbols_of_elements(const std::vector<std::string>& names,
                                               const ExprVector& values);

}  // namespace courant
