#include "courant/core/dense_solver.hpp"

#include <algorithm>
#include <cmath>

#include "courant/core/complete_orthogonal_decomposition.hpp"
#include "courant/core/equilibration.hpp"
#include "courant/core/regular_matrix.hpp"
#include "courant/core/small_product.hpp"
#include "courant/core/static_size.hpp"

namespace courant {

using regular_matrix::kNoise;
using regular_matrix::kRegular;
using regular_matrix::kSingular;

namespace {

// Of the entries of a matrix that is taken as singular, next to the largest: what is above about
// 1e-11 is divided by.
constexpr double kDataError = 2e-14;

// x = A b, for a square A of n rows or (Eigen::Dynamic) any.
template <int n>
void multiply(const MatrixXd& A, const double* b, double* x) {
  if constexpr (n == Eigen::Dynamic) {
    Eigen::Map<VectorXd>(x, A.rows()).noalias() =
        A.operator*(Eigen::Map<const VectorXd>(b, A.cols()));
  } else {
    Eigen::Map<Eigen::Array<double, n, 1>>(x, n) = small_product<n>(A.data(), b);
  }
}

}  // namespace

DenseSolver::DenseSolver(const MatrixPattern& pattern)
    : pattern_(pattern),
      A_(pattern.rows, pattern.columns),
      scaled_(pattern.rows, pattern.columns),
      row_(pattern.rows),
      column_(pattern.columns),
      largest_(pattern.rows),
      inverse_(pattern.columns, pattern.rows),
      multiply_(with_static_size(pattern.rows == pattern.columns ? pattern.rows : 0,
                                 [](auto n) { return &multiply<decltype(n)::value>; })) {}

// The rank is that of the equilibrated matrix S = diag(r) A diag(c): a small column is that of an
// unknown with a unit of its own, and no dependent one. Where it leaves unknowns open, those of least
// change are found in the units that they have.
void DenseSolver::pseudo_invert(const Equilibration<MatrixXd>& S) {
  const CompleteOrthogonalDecomposition decomposition(S.scaled, kDataError);
  determined_ = decomposition.rank() == A_.cols();
  inverse_ = S.column_scale.asDiagonal() * decomposition.pseudo_inverse();
  if (!determined_) {
    const CompleteOrthogonalDecomposition as_it_is(S.row_scale.asDiagonal() * A_, kDataError);
    if (as_it_is.rank() == decomposition.rank()) inverse_ = as_it_is.pseudo_inverse();
  }
  inverse_ = inverse_ * S.row_scale.asDiagonal();
  if (!determined_) open_ = MatrixXd::Identity(A_.cols(), A_.cols()) - inverse_ * A_;
}

void DenseSolver::do_settle(double* x, const double* x0) {
  if (determined_) return;
  Eigen::Map<VectorXd> settled(x, open_.cols());
  settled -= (open_ * (settled - Eigen::Map<const VectorXd>(x0, open_.cols()))).eval();
}

bool DenseSolver::do_factorize(const double* entries) {
  A_.setZero();
  for (std::size_t k = 0; k < pattern_.row.size(); ++k)
    A_(pattern_.row[k], pattern_.column[k]) = entries[k];
  determined_ = false;
  orientation_ = 0;
  if (!A_.allFinite()) return false;
  if (A_.size() == 0) return determined_ = true;

  if (A_.rows() == A_.cols()) {
    equilibrate_by_powers();
    determined_ = invert(scaled_, row_, column_, kRegular);
  }
  if (!determined_) {
    const Equilibration<MatrixXd> S = equilibrate(A_, kNoise);
    determined_ =
        A_.rows() == A_.cols() && invert(S.scaled, S.row_scale, S.column_scale, kSingular);
    if (!determined_) pseudo_invert(S);
  }
  return inverse_.allFinite();
}

// Both kinds of units, twice: rows by columns in units of their own, and columns by such rows. Loops, since
// expressions take up to twice as long for matrices of four rows.
void DenseSolver::equilibrate_by_powers() {
  const Index n = A_.rows();
  row_.setOnes();
  column_.setOnes();
  scaled_ = A_;
  for (int sweep = 0; sweep < 2; ++sweep) {
    largest_.setZero();
    for (Index j = 0; j < n; ++j) {
      double size = 0.0;
      for (Index i = 0; i < n; ++i) size = std::max(size, std::fabs(scaled_(i, j)));
      regular_matrix::scale_to_one(size, column_[j]);
      for (Index i = 0; i < n; ++i) {
        scaled_(i, j) = A_(i, j) * column_[j];
        largest_[i] = std::max(largest_[i], std::fabs(row_[i] * scaled_(i, j)));
      }
    }
    for (Index i = 0; i < n; ++i) regular_matrix::scale_to_one(largest_[i], row_[i]);
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i < n; ++i) scaled_(i, j) *= row_[i];
  }
}

// The inverse of A, where S = diag(row) A diag(column), unless its pivots are too small.
bool DenseSolver::invert(const MatrixXd& S, const VectorXd& row, const VectorXd& column,
                         double least_ratio) {
  lu_.compute(S);
  if (!(lu_.pivot_ratio() > least_ratio)) return false;
  lu_.inverse(inverse_);
  for (Index j = 0; j < inverse_.cols(); ++j)
    for (Index i = 0; i < inverse_.rows(); ++i)
      inverse_(i, j) = column[i] * inverse_(i, j) * row[j];
  orientation_ = lu_.orientation();
  return true;
}

}  // namespace courant
