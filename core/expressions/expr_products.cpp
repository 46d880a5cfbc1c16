#include <stdexcept>
#include <string>

#include "courant/core/expressions/expr.hpp"

namespace courant {
namespace {

void check_sizes(Index columns, Index rows) {
  if (columns != rows)
    throw std::invalid_argument("product: A has " + std::to_string(columns) +
                                " columns, the right factor " + std::to_string(rows) +
                                " rows; expected the same number.");
}

}  // namespace

ExprVector product(const ExprMatrix& A, const ExprVector& x) {
  check_sizes(A.cols(), x.size());
  ExprVector result = ExprVector::Zero(A.rows());
  for (Index i = 0; i < A.rows(); ++i)
    for (Index j = 0; j < A.cols(); ++j) result[i] += A(i, j) * x[j];
  return result;
}

ExprMatrix product(const ExprMatrix& A, const ExprMatrix& B) {
  check_sizes(A.cols(), B.rows());
  ExprMatrix result = ExprMatrix::Zero(A.rows(), B.cols());
  for (Index j = 0; j < B.cols(); ++j)
    for (Index i = 0; i < A.rows(); ++i)
      for (Index k = 0; k < A.cols(); ++k) result(i, j) += A(i, k) * B(k, j);
  return result;
}

}  // namespace courant
