#include "courant/core/expr_vectors.hpp"

#include "courant/core/derivative.hpp"

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

bool depends(const ExprVector& y, const ExprVector& x) { return jacobian(y, x).values.size() > 0; }

}  // namespace courant
