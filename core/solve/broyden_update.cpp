#include "courant/core/solve/broyden_update.hpp"

#include <cmath>

#include "courant/core/linear/pairs.hpp"
#include "courant/core/linear/static_size.hpp"

namespace courant {
namespace {

// aᵀ b of `size` numbers, or n where that is dynamic.
template <int size>
double dot(const double* a, const double* b, Index n) {
  if constexpr (size != Eigen::Dynamic) n = size;
  PairSum sum;
  for_each_pair(0, n, [&]<class Numbers>(Index i, Numbers) {
    sum.add(Numbers(read<Numbers>(a + i) * read<Numbers>(b + i)));
  });
  return sum.value();
}

template <int size>
bool update(double* A, const double* s, const double* r, const double* weighted, Index n) {
  if constexpr (size != Eigen::Dynamic) n = size;
  const double length = dot<size>(weighted, s, n);
  const double along = dot<size>(weighted, r, n);
  if (!(std::fabs(along) <= 0.5 * length && length > 0.0 && std::isfinite(length))) return false;
  const double factor = 1.0 / (length - along);
  for (Index j = 0; j < n; ++j, A += n) {
    const double part = dot<size>(weighted, A, n) * factor;
    for_each_pair(0, n, [&]<class Numbers>(Index i, Numbers) {
      write(A + i, Numbers(read<Numbers>(A + i) + read<Numbers>(r + i) * part));
    });
  }
  return true;
}

}  // namespace

bool broyden_update(double* A, const double* s, const double* r, const double* weighted, Index n) {
  return with_static_size(
      n, [&](auto size) { return update<decltype(size)::value>(A, s, r, weighted, n); });
}

}  // namespace courant
