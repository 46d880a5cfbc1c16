// The functions that a formula can call.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "courant/core/language/formula_value.hpp"

namespace courant::formula {

// A function of the formula language: its name, how many arguments it takes, and what it makes of them.
struct NamedFunction {
  using Arguments = std::span<const Value>;

  std::string_view name;
  std::size_t least, most;  // number of arguments
  // Null for sum, prod and if, which are not functions of values: the parser carries them out.
  Value (*apply)(std::size_t column, Arguments arguments);
};

// Null if there is none.
const NamedFunction* find_function(std::string_view name);

std::vector<std::string> function_names();

}  // namespace courant::formula
