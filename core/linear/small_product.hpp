// Products with little matrices.
#pragma once

#include "courant/core/numbers/vectors.hpp"

namespace courant {

// A b for A of n × n, column by column. The sum over columns is added up in two parts, even ones and odd ones,
// which wait half as long for themselves as one; programs in C that do the same get the same bits. b is read number by
// number, as it has just been written: a packet would wait until that has reached the cache. A is aligned as matrices
// of Eigen are.
template <int n>
[[gnu::always_inline]] inline Eigen::Array<double, n, 1> small_product(const double* A,
                                                                       const double* b) {
  const Eigen::Map<const Eigen::Array<double, n, n>, Eigen::Aligned16> columns(A);
  Eigen::Array<double, n, 1> even = columns.col(0) * b[0];
  if constexpr (n > 1) {
    Eigen::Array<double, n, 1> odd = columns.col(1) * b[1];
    for (int j = 2; j + 1 < n; j += 2) {
      even += columns.col(j) * b[j];
      odd += columns.col(j + 1) * b[j + 1];
    }
    if constexpr (n > 2 && n % 2 == 1) even += columns.col(n - 1) * b[n - 1];
    even += odd;
  }
  return even;
}

}  // namespace courant
