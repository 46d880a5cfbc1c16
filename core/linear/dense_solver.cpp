#include "courant/core/linear/dense_solver.hpp"

#include <algorithm>
#include <cmath>

#include "courant/core/linear/complete_orthogonal_decomposition.hpp"
#include "courant/core/linear/equilibration.hpp"
#include "courant/core/linear/pairs.hpp"
#include "courant/core/linear/regular_matrix.hpp"
#include "courant/core/linear/small_product.hpp"
#include "courant/core/linear/static_size.hpp"

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

DenseSolver::DenseSolver(const MatrixPattern& pattern, Keeps keeps)
    : pattern_(pattern),
      keeps_(keeps),
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

void DenseSolver::do_solve(const double* b, double* x) {
  if (!has_factors_) return multiply_(inverse_, b, x);
  for (Index i = 0; i < row_.size(); ++i) x[i] = row_[i] * b[i];
  lu_.solve(x);
  for (Index i = 0; i < column_.size(); ++i) x[i] *= column_[i];
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
  determined_ = has_factors_ = false;
  orientation_ = 0;
  if (!are_finite(A_.data(), A_.size())) return false;
  if (A_.size() == 0) return determined_ = true;

  const bool is_square = A_.rows() == A_.cols();
  if (is_square) {
    equilibrate_by_powers();
    if (decompose(scaled_, kRegular)) {
      has_factors_ = keeps_ == Keeps::factors;
      if (has_factors_) return true;
      invert(row_, column_);
    }
  }
  if (!determined_) {
    const Equilibration<MatrixXd> S = equilibrate(A_, kNoise);
    if (is_square && decompose(S.scaled, kSingular))
      invert(S.row_scale, S.column_scale);
    else
      pseudo_invert(S);
  }
  return are_finite(inverse_.data(), inverse_.size());
}

// Both kinds of units, twice: rows by columns in units of their own, and columns by such rows. Loops, since
// expressions take up to twice as long for matrices of four rows.
void DenseSolver::equilibrate_by_powers() {
  const Index n = A_.rows();
  row_.setOnes();
  column_.setOnes();
  scaled_ = A_;
  double* const row = row_.data();
  double* const largest = largest_.data();
  for (int sweep = 0; sweep < 2; ++sweep) {
    largest_.setZero();
    for (Index j = 0; j < n; ++j) {
      const double* const from = A_.data() + j * n;
      double* const to = scaled_.data() + j * n;
      PairMaximum size;
      for_each_pair(0, n, [&]<class Numbers>(Index i, Numbers) {
        size.add(Numbers(magnitude(read<Numbers>(to + i))));
      });
      regular_matrix::scale_to_one(size.value(), column_[j]);
      const double unit = column_[j];
      for_each_pair(0, n, [&]<class Numbers>(Index i, Numbers) {
        const Numbers scaled = read<Numbers>(from + i) * unit;
        write(to + i, scaled);
        write(largest + i, larger(read<Numbers>(largest + i),
                                  Numbers(magnitude(Numbers(read<Numbers>(row + i) * scaled)))));
      });
    }
    for (Index i = 0; i < n; ++i) regular_matrix::scale_to_one(largest[i], row[i]);
    for (Index j = 0; j < n; ++j) {
      double* const to = scaled_.data() + j * n;
      for_each_pair(0, n, [&]<class Numbers>(Index i, Numbers) {
        write(to + i, Numbers(read<Numbers>(to + i) * read<Numbers>(row + i)));
      });
    }
  }
}

// The factors of S, unless its pivots are too small.
bool DenseSolver::decompose(const MatrixXd& S, double least_ratio) {
  lu_.compute(S);
  determined_ = lu_.pivot_ratio() > least_ratio;
  if (determined_) orientation_ = lu_.orientation();
  return determined_;
}

// The inverse of A, where the factors are those of diag(row) A diag(column).
void DenseSolver::invert(const VectorXd& row, const VectorXd& column) {
  lu_.inverse(inverse_);
  const Index n = inverse_.rows();
  for (Index j = 0; j < n; ++j) {
    double* const entries = inverse_.data() + j * n;
    const double unit = row[j];
    for_each_pair(0, n, [&]<class Numbers>(Index i, Numbers) {
      write(entries + i,
            Numbers(read<Numbers>(column.data() + i) * read<Numbers>(entries + i) * unit));
    });
  }
}

}  // namespace courant
