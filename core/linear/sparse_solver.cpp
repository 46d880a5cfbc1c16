#include "courant/core/linear/sparse_solver.hpp"

#include <algorithm>
#include <cmath>

#include "courant/core/linear/regular_matrix.hpp"
#include "courant/core/linear/sparse_lu.hpp"

namespace courant {

using regular_matrix::kNoise;
using regular_matrix::kRegular;
using regular_matrix::kSingular;

namespace {

// S ← diag(r) A diag(c), where S has the entries of A at the same places.
void scale(const SparseMatrixXd& A, const VectorXd& r, const VectorXd& c, SparseMatrixXd& S) {
  const double* entry = A.valuePtr();
  const int* row = A.innerIndexPtr();
  double* scaled = S.valuePtr();
  for (Index j = 0; j < A.cols(); ++j)
    for (int k = A.outerIndexPtr()[j]; k < A.outerIndexPtr()[j + 1]; ++k)
      scaled[k] = r[row[k]] * entry[k] * c[j];
}

// Divides scales by powers of two near the largest entry of each row, or column.
void level(const SparseMatrixXd& S, bool by_row, VectorXd& scales, VectorXd& largest) {
  largest.setZero(scales.size());
  for (Index j = 0; j < S.cols(); ++j)
    for (SparseMatrixXd::InnerIterator it(S, j); it; ++it) {
      double& most = largest[by_row ? it.row() : j];
      most = std::max(most, std::fabs(it.value()));
    }
  for (Index i = 0; i < scales.size(); ++i) regular_matrix::scale_to_one(largest[i], scales[i]);
}

}  // namespace

SparseSolver::SparseSolver(const MatrixPattern& pattern)
    : pattern_(pattern), A_(pattern.rows, pattern.columns) {
  std::vector<Eigen::Triplet<double>> ones;
  for (std::size_t k = 0; k < pattern.row.size(); ++k)
    ones.emplace_back(static_cast<int>(pattern.row[k]), static_cast<int>(pattern.column[k]), 1.0);
  A_.setFromTriplets(ones.begin(), ones.end());
  A_.makeCompressed();
  const int* rows = A_.innerIndexPtr();
  for (std::size_t k = 0; k < pattern.row.size(); ++k) {
    const int* begin = rows + A_.outerIndexPtr()[pattern.column[k]];
    const int* end = rows + A_.outerIndexPtr()[pattern.column[k] + 1];
    place_.push_back(std::lower_bound(begin, end, pattern.row[k]) - rows);
  }
  scaled_ = A_;
  row_scale_ = VectorXd::Ones(A_.rows());
  column_scale_ = VectorXd::Ones(A_.cols());
  if (A_.rows() == A_.cols()) lu_ = std::make_unique<SparseLu>(scaled_);
}

SparseSolver::~SparseSolver() = default;

bool SparseSolver::is_regular(double least_ratio) {
  return lu_->factorize(scaled_) && lu_->pivot_ratio() > least_ratio;
}

bool SparseSolver::do_factorize(const double* entries) {
  is_sparse_ = false;
  Eigen::Map<VectorXd> values(A_.valuePtr(), A_.nonZeros());
  values.setZero();
  for (std::size_t k = 0; k < place_.size(); ++k) values[place_[k]] += entries[k];
  if (lu_ && values.allFinite()) {
    // Both kinds of units, twice: rows by columns in units of their own, and columns by such rows.
    row_scale_.setOnes();
    column_scale_.setOnes();
    scaled_ = A_;
    for (const bool by_row : {false, true, false, true}) {
      level(scaled_, by_row, by_row ? row_scale_ : column_scale_, largest_);
      scale(A_, row_scale_, column_scale_, scaled_);
    }
    is_sparse_ = is_regular(kRegular);
    if (!is_sparse_) {
      const Equilibration<SparseMatrixXd> S = equilibrate(A_, kNoise);
      row_scale_ = S.row_scale;
      column_scale_ = S.column_scale;
      scale(A_, row_scale_, column_scale_, scaled_);
      is_sparse_ = is_regular(kSingular);
    }
    has_units_ = (row_scale_.array() != 1.0).any() || (column_scale_.array() != 1.0).any();
    if (is_sparse_) return true;
  }
  if (!dense_) dense_ = std::make_unique<DenseSolver>(pattern_);
  return dense_->factorize(entries);
}

void SparseSolver::do_solve(const double* b, double* x) {
  if (!is_sparse_) return dense_->solve(b, x);
  Eigen::Map<VectorXd> result(x, column_scale_.size());
  const Eigen::Map<const VectorXd> given(b, row_scale_.size());
  if (!has_units_) {  // passes over large vectors are as dear as factors
    result = given;
    return lu_->solve(x);
  }
  result = row_scale_.cwiseProduct(given);
  lu_->solve(x);
  result.array() *= column_scale_.array();
}

void SparseSolver::do_settle(double* x, const double* x0) {
  if (dense_ && !is_sparse_) dense_->settle(x, x0);
}

int SparseSolver::do_orientation() const {
  return is_sparse_ ? lu_->orientation() : dense_ ? dense_->orientation() : 0;
}

}  // namespace courant
