// Where a function of a formula leaves its domain.
#pragma once

#include <optional>
#include <string>

#include "courant/core/expressions/expr.hpp"

namespace courant {

// A function whose value is not finite though its arguments are.
struct Undefined {
  Index output;         // the first of the expressions that it makes not finite
  std::string formula;  // the function as it stands there: "sqrt(x - 2)"
  std::string reason;   // "the argument of sqrt is -1", "the divisor is 0", "exp overflows at 1000"
};

// The first such function, arguments before what is made of them, that makes one of `outputs` not
// finite at `values` of `variables`; nothing if they are all finite, or a value is not. Variables that
// are not given are 0.
std::optional<Undefined> find_undefined(const ExprVector& outputs, const ExprVector& variables,
                                        const VectorXd& values);

}  // namespace courant
