#include "courant/core/broyden_update.hpp"

#include <cmath>

#include "courant/core/static_size.hpp"

namespace courant {
namespace {

using Two = Eigen::Array2d;

double dot(const double* a, const double* b, Index n) {
  Two sums = Two::Zero();
  Index i = 0;
  for (; i + 1 < n; i += 2) sums += Eigen::Map<const Two>(a + i) * Eigen::Map<const Two>(b + i);
  if (i < n) sums[0] += a[i] * b[i];
  return sums[0] + sums[1];
}

// A ← A + r (sᵀ W A) factor, for `size` rows, or n where that is dynamic.
template <int size>
void add(double* A, const double* r, const double* weighted, double factor, Index n) {
  if constexpr (size != Eigen::Dynamic) n = size;
  for (Index j = 0; j < n; ++j, A += n) {
    const double part = dot(weighted, A, n) * factor;
    Index i = 0;
    for (; i + 1 < n; i += 2) Eigen::Map<Two>(A + i) += Eigen::Map<const Two>(r + i) * part;
    if (i < n) A[i] += r[i] * part;
  }
}

}  // namespace

bool broyden_update(double* A, const VectorXd& s, const VectorXd& r, const VectorXd& weighted) {
  const Index n = s.size();
  const double length = dot(weighted.data(), s.data(), n);
  const double along = dot(weighted.data(), r.data(), n);
  if (!(std::fabs(along) <= 0.5 * length && length > 0.0 && std::isfinite(length))) return false;
  const double factor = 1.0 / (length - along);
  with_static_size(
      n, [&](auto size) { add<decltype(size)::value>(A, r.data(), weighted.data(), factor, n); });
  return true;
}

}  // namespace courant
