#include "courant/core/expressions/expr_vectors.hpp"

#include "courant/core/expressions/derivative.hpp"

namespace courant {

ExprVector joined(const std::vector<ExprVector>& parts) {
  Index size = 0;
  for (const ExprVector& part : parts) size += part.size();
  ExprVector result(size);
  Index offset = 0;
  for (const ExprVector& part : parts) {
    result.segment(offset, part.size()) = part;
    offset += part.size();
  }
  return result;
}

std::vector<bool> each_depends(const ExprVector& y, const ExprVector& x) {
  std::vector<bool> result(static_cast<std::size_t>(y.size()), false);
  for (const Index row : jacobian(y, x).row) result[static_cast<std::size_t>(row)] = true;
  return result;
}

bool depends(const ExprVector& y, const ExprVector& x) { return jacobian(y, x).values.size() > 0; }

}  // namespace courant
