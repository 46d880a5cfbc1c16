// FormulaTree: a formula as it is written, for who sets it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace courant {

// The syntax of one formula of the language of parse_formula: what stands in it, in the order in which it was
// written. Nothing is computed and names need not be known, so 1/2*x stays (1/2)*x.
//
//   number        text: its digits                          no operands
//   name          text: x, with one ' for each derivative   no operands
//   element       text "", operands: array, index
//   call          text: the function, operands: arguments; sum(i, a, b, f) likewise
//   sign          text: - + !,  operands: one
//   operation     text: + - * / ^ < <= > >= == != && ||, operands: two
//   equation      text "=", operands: two
//
// Parentheses are not kept: the tree says what belongs together.
struct FormulaTree {
  enum class Kind { number, name, element, call, sign, operation, equation };

  Kind kind;
  std::string text;
  std::vector<FormulaTree> operands = {};
};

// The formula, or the equation `formula = formula`; nothing where the text is none, or is nested deeper than
// 100 levels.
std::optional<FormulaTree> formula_tree(std::string_view text);

}  // namespace courant
