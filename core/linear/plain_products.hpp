// Products of matrices by plain loops.
#pragma once

#include <cmath>

#include "courant/core/linear/pairs.hpp"

namespace courant {

// C = A B, column by column: A is rows × inner, B inner × columns, or square and of n columns where n is known. Each
// entry is the sum of its terms in their order, as programs in C add them up too, to the last bit.
template <int n = Eigen::Dynamic>
inline void plain_product(const double* A, Index rows, const double* B, Index inner, Index columns,
                          double* C) {
  if constexpr (n != Eigen::Dynamic) inner = columns = n;
  for (Index j = 0; j < columns; ++j) {
    double* const c = C + j * rows;
    const double* const b = B + j * inner;
    for (Index i = 0; i < rows; ++i) c[i] = inner > 0 ? A[i] * b[0] : 0.0;
    for (Index k = 1; k < inner; ++k)
      for (Index i = 0; i < rows; ++i) c[i] += A[i + k * rows] * b[k];
  }
}

// Σ a_i b_i in two parts, even places and odd ones.
inline double plain_product(const double* a, const double* b, Index count) {
  PairSum sum;
  for_each_pair(0, count, [&]<class Numbers>(Index i, Numbers) {
    sum.add(Numbers(read<Numbers>(a + i) * read<Numbers>(b + i)));
  });
  return sum.value();
}

// The first of the longest columns of A (rows × columns, column by column), and the square of its length.
struct LongestColumn {
  Index index = 0;
  double square = 0.0;
};
inline LongestColumn longest_column(const double* A, Index rows, Index columns) {
  LongestColumn result;
  for (Index j = 0; j < columns; ++j) {
    const double square = plain_product(A + j * rows, A + j * rows, rows);
    if (!(square <= result.square)) result = {.index = j, .square = square};
  }
  return result;
}

// C = A B and C = Aᵀ B for a C of their size.
inline void multiply_plainly(const MatrixXd& A, const MatrixXd& B, MatrixXd& C) {
  plain_product(A.data(), A.rows(), B.data(), A.cols(), B.cols(), C.data());
}
inline void multiply_transposed_plainly(const MatrixXd& A, const MatrixXd& B, MatrixXd& C) {
  for (Index j = 0; j < B.cols(); ++j)
    for (Index i = 0; i < A.cols(); ++i)
      C(i, j) = plain_product(A.data() + i * A.rows(), B.data() + j * B.rows(), A.rows());
}

// ‖a - b‖₂
inline double plain_distance(const double* a, const double* b, Index count) {
  double sum = 0.0;
  for (Index i = 0; i < count; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

}  // namespace courant
