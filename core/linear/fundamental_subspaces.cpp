#include "courant/core/linear/fundamental_subspaces.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "courant/core/linear/equilibration.hpp"
#include "courant/core/linear/lu_decomposition.hpp"
#include "courant/core/linear/qr_decomposition.hpp"
#include "courant/core/linear/rank_cut.hpp"
#include "courant/core/linear/singular_value_decomposition.hpp"

namespace courant {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

RankDecision decide(Index rows, Index columns, const VectorXd& values, const RankOptions& options) {
  RankDecision decision;
  decision.rows = rows;
  decision.columns = columns;
  decision.singular_values = values;
  const auto value = [&](Index k) { return k < values.size() ? values[k] : 0.0; };
  const NoiseLevel noise = noise_level(rows, columns, value(0), options);
  const Index rank = count_above_cut(values, noise);
  conclude(decision, rank, rank > 0 ? value(rank - 1) : 0.0, value(rank), noise);
  return decision;
}

// A with its rows and columns equilibrated unless the options say that its magnitude is known.
Equilibration<MatrixXd> comparable(const Eigen::Ref<const MatrixXd>& A,
                                   const RankOptions& options) {
  if (options.magnitude == 0.0) return equilibrate(A, entry_noise(options));
  if (!A.allFinite()) {
    throw std::domain_error("decide_rank: the matrix has entries that are not finite numbers.");
  }
  return {A, VectorXd::Ones(A.rows()), VectorXd::Ones(A.cols())};
}

// The orthogonal matrix [W^⊥ W], W the span of diag(scale)·X, X with orthonormal columns.
//
// Householder QR with pivoted columns and the rows in decreasing order is backward stable in each
// row (Cox & Higham, Stability of Householder QR factorization for weighted least squares problems,
// 1998). In any other order a row with a scale of 1e-6 among others of 1e6 keeps 4 digits instead
// of 15.
MatrixXd complement_and_span(const VectorXd& scale, const MatrixXd& X) {
  const Index n = X.rows(), k = X.cols();
  Eigen::PermutationMatrix<Eigen::Dynamic> order(n);
  order.setIdentity();
  std::sort(order.indices().begin(), order.indices().end(),
            [&](int i, int j) { return scale[i] > scale[j]; });
  const MatrixXd sorted = order.transpose() * (scale.asDiagonal() * X);
  const MatrixXd Q = QrDecomposition::pivoted(sorted).Q();
  MatrixXd result(n, n);
  result << order * Q.rightCols(n - k), order * Q.leftCols(k);
  return result;
}

// How far the columns of L are from zeros of Lᵀa for the columns a of A, next to their lengths.
double residual(const MatrixXd& A, const MatrixXd& L) {
  double largest = 0.0;
  if (L.cols() == 0) return largest;
  for (const auto& a : A.colwise())
    if (const double length = a.norm(); length > 0.0)
      largest = std::max(largest, (L.transpose() * a).norm() / length);
  return largest;
}

}  // namespace

RankDecision decide_rank(const Eigen::Ref<const MatrixXd>& A, const RankOptions& options) {
  const MatrixXd scaled = comparable(A, options).scaled;
  return decide(A.rows(), A.cols(), singular_values(scaled), options);
}

FundamentalSubspaces::FundamentalSubspaces(const Eigen::Ref<const MatrixXd>& A,
                                           const RankOptions& options) {
  const auto [scaled, row_scale, column_scale] = comparable(A, options);
  const auto [values, U, V] = singular_value_decomposition(scaled);
  decision_ = decide(A.rows(), A.cols(), values, options);
  // S = diag(r) A diag(c): Sz = 0 means A(cz) = 0, and wᵀS = 0 means (rw)ᵀA = 0.
  rows_ = complement_and_span(column_scale, V.rightCols(A.cols() - rank()));
  columns_ = complement_and_span(row_scale, U.rightCols(A.rows() - rank()));
  if (options.magnitude == 0.0) prefer_smaller_residuals(A, options);
  core_ = range().transpose() * A * row_space();
}

void FundamentalSubspaces::prefer_smaller_residuals(const Eigen::Ref<const MatrixXd>& A,
                                                    const RankOptions& options) {
  const auto size = static_cast<double>(std::max(A.rows(), A.cols()));
  const double expected = 100.0 * (size * eps + std::sqrt(size) * options.data_error);
  const double in_rows = residual(A.transpose(), kernel());
  const double in_columns = residual(A, left_kernel());
  if (in_rows <= expected && in_columns <= expected) return;
  const auto [values, U, V] = singular_value_decomposition(A);
  const MatrixXd kernel = V.rightCols(A.cols() - rank());
  const MatrixXd left_kernel = U.rightCols(A.rows() - rank());
  if (in_rows > expected && residual(A.transpose(), kernel) < in_rows)
    rows_ = complement_and_span(VectorXd::Ones(A.cols()), kernel);
  if (in_columns > expected && residual(A, left_kernel) < in_columns)
    columns_ = complement_and_span(VectorXd::Ones(A.rows()), left_kernel);
}

MatrixXd FundamentalSubspaces::pseudo_solve(const Eigen::Ref<const MatrixXd>& B) const {
  if (B.rows() != decision_.rows) {
    throw std::invalid_argument("FundamentalSubspaces::pseudo_solve: B has " +
                                std::to_string(B.rows()) + " rows; expected those of A, " +
                                std::to_string(decision_.rows) + ".");
  }
  if (rank() == 0) return MatrixXd::Zero(decision_.columns, B.cols());
  return row_space() * LuDecomposition(core_).solve(range().transpose() * B);
}

MatrixXd kernel(const Eigen::Ref<const MatrixXd>& A, const RankOptions& options) {
  return FundamentalSubspaces(A, options).kernel();
}

MatrixXd range(const Eigen::Ref<const MatrixXd>& A, const RankOptions& options) {
  return FundamentalSubspaces(A, options).range();
}

}  // namespace courant
