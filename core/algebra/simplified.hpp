// The text of a formula as one writes it by hand.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "courant/core/expressions/expr.hpp"

namespace courant {

// What a formula is an expression of: relations that hold where it is looked at, each = 0.
struct Simplification {
  // Polynomials, such as x² + y² + z² - 1 on a sphere: a multiple of all their terms but the constant ones, which have
  // numbers and parameters alone, is replaced by that multiple of the constants. What is zero on all points where they
  // are, as a consequence of several of them too, is found to be 0.
  std::vector<Expr> relations = {};
  // The same, but nothing more is concluded from them than the replacement of multiples.
  std::vector<Expr> constraints = {};
};

// The expression as a sum of terms, terms with the same factors put together:
//
//   0.5*p + 0.5*p            p
//   (1 - 2*1/y)/(1/y*1/x)    x*y - 2*x
//   sin(a)^2 + cos(a)^2      1
//
// Products of sums are multiplied out where that makes the text shorter. Numbers that are round-off
// of what they were added up from are left out; 0.159154943091895 is written 1/(2*pi), other numbers
// with six digits. No value where the expression has more than a few hundred terms.
std::optional<std::string> simplified(const Expr& a, const Simplification& given = {});

// The same of an equation a = 0, which may be divided: by numbers and parameters, which are not 0, and by what stands
// under all of its terms or is a denominator of all.
std::optional<std::string> simplified_equation(const Expr& a, const Simplification& given = {});

}  // namespace courant
