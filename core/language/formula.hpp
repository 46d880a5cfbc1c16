// Formulas: the language in which experiments write mathematics.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "courant/core/language/formula_error.hpp"
#include "courant/core/language/symbol_table.hpp"

namespace courant {

// The number that a formula such as `sum(i, 0, n-2, (q[i+1] - q[i])^2)/2 - k*cos(x)` stands for, in
// the graph of the symbols; a constant if only constants are in it.
//
//   numbers      1  .5  1e-3  pi  e; names of the table; x[2]  r[i+1][j-1]; velocities x'  r[2]'
//   signs        ||  &&  < <= > >= == !=  + -  * /  unary - + !  ^, and parentheses; tightest
//                last, and ^ to the right: -x^2 = -(x²), 2^-1 = ½, a^b^c = a^(b^c)
//   functions    sqrt exp log sin cos tan asin acos atan atan2 sinh cosh tanh abs sign pow,
//                min max (of two or more), dot(a, b), cross(a, b), norm(a)
//   sums         sum(i, first, last, term), prod likewise: i is a new name and an integer constant
//                in `term`; empty (0 or 1) if last < first
//   conditions   if(condition, a, b); conditions are not numbers, and comparisons do not chain
//
// An array, or a row of an array of arrays, is a vector: vectors add, subtract, take numbers as
// factors and are what dot, cross and norm work on: `norm(r[i] - r[j])`, `cross(q, p)[2]`.
// Indices and bounds must be constant integers. What a known condition rules out may have indices
// out of range: `if(i < n-1, q[i+1], q[0])`. Refused: nesting beyond 200 levels, more than 10⁶
// terms in all sums together (nested ones counted as rectangles), or 5·10⁵ that are no numbers.
// Throws FormulaError.
Expr parse_formula(std::string_view text, const SymbolTable& symbols);

// The names that a formula needs, in order of appearance, velocities as `x'`: without functions,
// `pi`, `e` and the indices of sums. Throws FormulaError only for what is no word of the language.
std::vector<std::string> names_used(std::string_view text);

}  // namespace courant
