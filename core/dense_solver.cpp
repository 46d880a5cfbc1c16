#include "courant/core/dense_solver.hpp"

#include <cmath>

#include "courant/core/complete_orthogonal_decomposition.hpp"
#include "courant/core/lu_decomposition.hpp"
#include "courant/core/static_size.hpp"

namespace courant {
namespace {

// Below this ratio of pivots (after scaling the rows) a square matrix is taken as singular.
// Round-off alone gives about 1e-16 n; a step whose matrix is that near to singular has no
// meaningful digits to lose.
constexpr double kSingular = 1e-13;

// Of the entries of a matrix that is taken as singular, next to the largest: what is above about
// 1e-11 is divided by.
constexpr double kDataError = 2e-14;

// x = A b, for a square A of n rows or (Eigen::Dynamic) any.
template <int n>
void multiply(const MatrixXd& A, const double* b, double* x) {
  if constexpr (n == Eigen::Dynamic) {
    Eigen::Map<VectorXd>(x, A.rows()).noalias() = A * Eigen::Map<const VectorXd>(b, A.cols());
  } else {
    // By numbers, not by packets: b has just been written number by number, and a packet would wait
    // until that has reached the cache.
    const double* entry = A.data();
    double sum[n] = {};
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) sum[i] += *entry++ * b[j];
    for (int i = 0; i < n; ++i) x[i] = sum[i];
  }
}

}  // namespace

DenseSolver::DenseSolver(const MatrixPattern& pattern)
    : pattern_(pattern),
      inverse_(pattern.columns, pattern.rows),
      multiply_(with_static_size(pattern.rows == pattern.columns ? pattern.rows : 0,
                                 [](auto n) { return &multiply<decltype(n)::value>; })) {}

// The columns are those of unknowns in units of their own: a small one is no dependent one. So the
// rank is that of A C, whose columns are of one size. Where it leaves unknowns open, those of least
// change are found in the units that they have.
void DenseSolver::pseudo_invert(const MatrixXd& A) {
  VectorXd C = A.colwise().lpNorm<Eigen::Infinity>();
  C = C.unaryExpr([](double size) { return size > 0.0 ? std::exp2(-std::ilogb(size)) : 1.0; });
  const MatrixXd scaled = A * C.asDiagonal();
  const CompleteOrthogonalDecomposition decomposition(scaled, kDataError);
  determined_ = decomposition.rank() == A.cols();
  if (!determined_) {
    const CompleteOrthogonalDecomposition as_it_is(A, kDataError);
    if (as_it_is.rank() == decomposition.rank()) {
      inverse_ = as_it_is.pseudo_inverse();
      return;
    }
  }
  inverse_ = C.asDiagonal() * decomposition.pseudo_inverse();
}

void DenseSolver::do_settle(double* x, Index first) {
  // The entries of a projection are known to about the error that the rank was decided with.
  constexpr double known = 1e-9;
  const Index size = open_.cols() - first;
  if (determined_ || size <= 0 || open_.topRows(first).norm() > known) return;
  Eigen::Map<VectorXd> rest(x + first, size);
  rest -= (open_.bottomRightCorner(size, size) * rest).eval();
}

bool DenseSolver::do_factorize(const double* entries) {
  MatrixXd A = MatrixXd::Zero(pattern_.rows, pattern_.columns);
  for (std::size_t k = 0; k < pattern_.row.size(); ++k)
    A(pattern_.row[k], pattern_.column[k]) = entries[k];
  determined_ = false;
  orientation_ = 0;
  if (!A.allFinite()) return false;
  if (A.size() == 0) return determined_ = true;

  VectorXd scale = A.rowwise().lpNorm<Eigen::Infinity>();
  scale = scale.unaryExpr([](double s) { return s > 0 ? 1.0 / s : 1.0; });
  A = scale.asDiagonal() * A;
  if (A.rows() == A.cols()) {
    const LuDecomposition lu(A);
    determined_ = lu.pivot_ratio() > kSingular;
    if (determined_) {
      inverse_ = lu.inverse();
      orientation_ = lu.orientation();
    }
  }
  if (!determined_) {
    pseudo_invert(A);
    if (!determined_) open_ = MatrixXd::Identity(A.cols(), A.cols()) - inverse_ * A;
  }
  inverse_ = inverse_ * scale.asDiagonal();
  return inverse_.allFinite();
}

}  // namespace courant
