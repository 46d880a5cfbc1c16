// FormulaError: what is wrong with a formula, and where.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace courant {

// Thrown by everything that reads formulas and names; what() is like
// `column 9: unknown name "qq" (did you mean "q"?)`.
class FormulaError : public std::invalid_argument {
 public:
  FormulaError(std::size_t column, const std::string& message)
      : std::invalid_argument("column " + std::to_string(column) + ": " + message),
        column_(column) {}

  // The offending place: counted from 1, in characters, not bytes; one past the last character for
  // a formula that ends too soon.
  std::size_t column() const { return column_; }

 private:
  std::size_t column_;
};

}  // namespace courant
