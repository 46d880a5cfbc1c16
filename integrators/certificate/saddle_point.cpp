#include "courant/integrators/certificate/saddle_point.hpp"

#include <algorithm>
#include <vector>

namespace courant {

bool is_factored_dense(const SparseMatrixXd& S) { return std::max(S.rows(), S.cols()) <= 200; }

SparseMatrixXd sparse_diagonal(const VectorXd& d) {
  SparseMatrixXd matrix(d.size(), d.size());
  matrix.setIdentity();
  return d.asDiagonal() * matrix;
}

SaddlePoint::SaddlePoint(const SparseMatrixXd& P, const SparseMatrixXd& S, double gamma)
    : columns_(S.cols()) {
  const Index n = S.cols(), m = S.rows();
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(P.nonZeros() + 2 * S.nonZeros() + m));
  for (Index j = 0; j < P.outerSize(); ++j)
    for (SparseMatrixXd::InnerIterator it(P, j); it; ++it)
      entries.emplace_back(static_cast<int>(it.row()), static_cast<int>(j), it.value());
  for (Index j = 0; j < S.outerSize(); ++j)
    for (SparseMatrixXd::InnerIterator it(S, j); it; ++it) {
      entries.emplace_back(static_cast<int>(n + it.row()), static_cast<int>(j), it.value());
      entries.emplace_back(static_cast<int>(j), static_cast<int>(n + it.row()), it.value());
    }
  for (Index i = 0; i < m; ++i)
    entries.emplace_back(static_cast<int>(n + i), static_cast<int>(n + i), -gamma);
  matrix_.resize(n + m, n + m);
  matrix_.setFromTriplets(entries.begin(), entries.end());
  factors_.compute(matrix_);
  // Without exchanges a pivot may cancel to 0.
  if (factors_.info() != Eigen::Success && is_factored_dense(matrix_))
    pivoted_.emplace(MatrixXd(matrix_));
}

VectorXd SaddlePoint::solve(const VectorXd& a, const VectorXd& b) const {
  if (factors_.info() != Eigen::Success && !pivoted_) return VectorXd();
  const auto applied = [&](const VectorXd& right) -> VectorXd {
    return pivoted_ ? VectorXd(pivoted_->solve(right)) : VectorXd(factors_.solve(right));
  };
  VectorXd right(a.size() + b.size());
  right << a, b;
  VectorXd solution = applied(right);
  for (int refinement = 0; refinement < 2; ++refinement)
    solution += applied(right - matrix_ * solution);
  return solution.head(a.size());
}

}  // namespace courant
