#include "courant/core/linear/lu_decomposition.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "courant/core/linear/static_size.hpp"

namespace courant {
namespace {

constexpr Index kPlain = LuDecomposition::kPlain;

// P A = L U in place, for n rows or (Eigen::Dynamic) `size`: row i of P A is row rows[i] of A. The sign of P.
template <int n>
int factorize(double* A, Index size, Index* rows) {
  if constexpr (n != Eigen::Dynamic) size = n;
  int sign = 1;
  for (Index i = 0; i < size; ++i) rows[i] = i;
  for (Index k = 0; k < size; ++k) {
    double* const factor = A + k * size;
    Index pivot = k;
    for (Index i = k + 1; i < size; ++i)
      if (std::fabs(factor[i]) > std::fabs(factor[pivot])) pivot = i;
    if (pivot != k) {
      for (Index j = 0; j < size; ++j) std::swap(A[k + j * size], A[pivot + j * size]);
      std::swap(rows[k], rows[pivot]);
      sign = -sign;
    }
    if (factor[k] != 0.0)
      for (Index i = k + 1; i < size; ++i) factor[i] /= factor[k];
    for (Index j = k + 1; j < size; ++j) {
      double* const column = A + j * size;
      for (Index i = k + 1; i < size; ++i) column[i] -= factor[i] * column[k];
    }
  }
  return sign;
}

// X = U⁻¹ L⁻¹ P. The entries of a row are found side by side, which none of them waits for; each has the order of operations
// of a column by itself.
template <int n>
void invert(const double* factors, Index size, const Index* rows, double* X) {
  if constexpr (n != Eigen::Dynamic) size = n;
  constexpr Index most = n == Eigen::Dynamic ? kPlain : Index{n};
  alignas(16) double Y[most * most];  // U⁻¹ L⁻¹, row by row
  std::fill_n(Y, size * size, 0.0);
  const auto subtract = [](double* y, double factor, const double* from, Index count) {
    for (Index j = 0; j < count; ++j) y[j] -= factor * from[j];
  };
  for (Index k = 0; k < size; ++k) {
    const double* const factor = factors + k * size;
    Y[k * size + k] = 1.0;
    for (Index i = k + 1; i < size; ++i) subtract(Y + i * size, factor[i], Y + k * size, k + 1);
  }
  for (Index k = size; k-- > 0;) {
    const double* const factor = factors + k * size;
    double* const y = Y + k * size;
    for (Index j = 0; j < size; ++j) y[j] /= factor[k];
    for (Index i = 0; i < k; ++i) subtract(Y + i * size, factor[i], y, size);
  }
  for (Index j = 0; j < size; ++j) {
    double* const x = X + rows[j] * size;
    for (Index i = 0; i < size; ++i) x[i] = Y[i * size + j];
  }
}

// b ← U⁻¹ L⁻¹ P b.
template <int n>
void solve_by_factors(const double* factors, Index size, const Index* rows, double* b) {
  if constexpr (n != Eigen::Dynamic) size = n;
  double x[n == Eigen::Dynamic ? kPlain : Index{n}];
  for (Index i = 0; i < size; ++i) x[i] = b[rows[i]];
  for (Index k = 0; k < size; ++k) {
    const double* const factor = factors + k * size;
    for (Index i = k + 1; i < size; ++i) x[i] -= factor[i] * x[k];
  }
  for (Index k = size; k-- > 0;) {
    const double* const factor = factors + k * size;
    x[k] /= factor[k];
    for (Index i = 0; i < k; ++i) x[i] -= factor[i] * x[k];
  }
  std::copy_n(x, size, b);
}

}  // namespace

void LuDecomposition::compute(const Eigen::Ref<const MatrixXd>& A) {
  if (A.rows() != A.cols())
    throw std::invalid_argument("LuDecomposition::compute: A is " + std::to_string(A.rows()) +
                                " × " + std::to_string(A.cols()) + "; expected a square matrix.");
  const bool is_of_same_size = A.rows() == size();
  factors_ = A;
  if (!is_of_same_size) rows_.resize(static_cast<std::size_t>(size()));
  if (size() <= kPlain) {
    sign_ = with_static_size(size(), [](auto n) { return &factorize<decltype(n)::value>; })(
        factors_.data(), size(), rows_.data());
    return;
  }
  const Eigen::PartialPivLU<Eigen::Ref<MatrixXd>> in_place(factors_);
  sign_ = static_cast<int>(in_place.permutationP().determinant());
  for (Index i = 0; i < size(); ++i)
    rows_[static_cast<std::size_t>(in_place.permutationP().indices()[i])] = i;
}

double LuDecomposition::pivot_ratio() const {
  if (size() == 0) return 1.0;
  const double largest = factors_.diagonal().cwiseAbs().maxCoeff();
  return largest > 0.0 ? factors_.diagonal().cwiseAbs().minCoeff() / largest : 0.0;
}

double LuDecomposition::determinant() const {
  double result = sign_;
  for (const double pivot : factors_.diagonal()) result *= pivot;
  return result;
}

int LuDecomposition::orientation() const {
  int result = sign_;
  for (const double pivot : factors_.diagonal()) result *= pivot > 0.0 ? 1 : pivot < 0.0 ? -1 : 0;
  return result;
}

MatrixXd LuDecomposition::solve(const Eigen::Ref<const MatrixXd>& B) const {
  if (B.rows() != size())
    throw std::invalid_argument("LuDecomposition::solve: B has " + std::to_string(B.rows()) +
                                " rows, expected " + std::to_string(size()) + ".");
  MatrixXd result = B(rows_, Eigen::all);
  factors_.triangularView<Eigen::UnitLower>().solveInPlace(result);
  factors_.triangularView<Eigen::Upper>().solveInPlace(result);
  return result;
}

void LuDecomposition::solve(double* b) const {
  if (size() <= kPlain)
    with_static_size(size(), [](auto n) { return &solve_by_factors<decltype(n)::value>; })(
        factors_.data(), size(), rows_.data(), b);
  else
    Eigen::Map<VectorXd>(b, size()) = solve(Eigen::Map<const VectorXd>(b, size()));
}

void LuDecomposition::inverse(MatrixXd& result) const {
  result.resize(size(), size());
  if (size() <= kPlain)
    with_static_size(size(), [](auto n) { return &invert<decltype(n)::value>; })(
        factors_.data(), size(), rows_.data(), result.data());
  else
    result = solve(MatrixXd::Identity(size(), size()));
}

MatrixXd LuDecomposition::inverse() const {
  MatrixXd result;
  inverse(result);
  return result;
}

}  // namespace courant
