// Vectors of expressions: put together, and asked what they depend on.
#pragma once

#include <vector>

#include "courant/core/expressions/expr.hpp"

namespace courant {

// One vector of all parts, in their order.
ExprVector joined(const std::vector<ExprVector>& parts);
template <class... Parts>
ExprVector joined(const Parts&... parts) {
  return joined(std::vector<ExprVector>{ExprVector(parts)...});
}

// Whether an entry of y changes with some of the variables x: whether ∂y/∂x has an entry that is not
// identically zero.
bool depends(const ExprVector& y, const ExprVector& x);
// The same of each entry of y by itself, in one pass.
std::vector<bool> each_depends(const ExprVector& y, const ExprVector& x);

}  // namespace courant
