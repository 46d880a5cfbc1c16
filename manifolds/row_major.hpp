// Matrices as vectors, row after row: how points that are matrices are stored.
#pragma once

#include "courant/core/expressions/expr.hpp"

namespace courant {

// The rows × cols matrix A with A(i, j) = a[cols·i + j].
inline ExprMatrix matrix_of(const ExprVector& a, Index rows, Index cols) {
  return a.reshaped<Eigen::RowMajor>(rows, cols);
}

// Its inverse: the entries of A, row after row.
inline ExprVector vector_of(const ExprMatrix& A) { return A.reshaped<Eigen::RowMajor>(); }

}  // namespace courant
