#include "courant/core/expressions/linear_algebra.hpp"

#include <stdexcept>
#include <string>

namespace courant {

ExprMatrix solve(ExprMatrix A, ExprMatrix b) {
  const Index n = A.rows();
  if (A.cols() != n || b.rows() != n)
    throw std::invalid_argument("solve: A is " + std::to_string(A.rows()) + " x " +
                                std::to_string(A.cols()) + " and b has " +
                                std::to_string(b.rows()) +
                                " rows; expected a square A with as many rows as b.");
  for (Index k = 0; k < n; ++k) {
    if (A(k, k).is_constant(0.0))
      throw std::domain_error("solve: pivot " + std::to_string(k) +
                              " is identically zero; expected regular leading minors.");
    for (Index i = k + 1; i < n; ++i) {
      const Expr factor = A(i, k) / A(k, k);
      if (factor.is_constant(0.0)) continue;
      for (Index j = k + 1; j < n; ++j) A(i, j) -= factor * A(k, j);
      for (Index j = 0; j < b.cols(); ++j) b(i, j) -= factor * b(k, j);
    }
  }
  for (Index k = n - 1; k >= 0; --k) {
    for (Index i = k + 1; i < n; ++i) {
      if (A(k, i).is_constant(0.0)) continue;
      for (Index j = 0; j < b.cols(); ++j) b(k, j) -= A(k, i) * b(i, j);
    }
    for (Index j = 0; j < b.cols(); ++j) b(k, j) = b(k, j) / A(k, k);
  }
  return b;
}

}  // namespace courant
