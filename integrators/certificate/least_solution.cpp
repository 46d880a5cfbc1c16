#include "courant/integrators/certificate/least_solution.hpp"

#include <limits>

namespace courant {

LeastSolution::LeastSolution(const SparseMatrixXd& A) : columns_(A.cols()) {
  constexpr double negligible_pivot = 1e-11, root = 1e-8;
  if (is_factored_dense(A))
    dense_.emplace(MatrixXd(A), negligible_pivot);
  else
    sparse_.emplace(sparse_diagonal(VectorXd::Constant(A.cols(), root)), A, root);
}

MatrixXd LeastSolution::solve(const MatrixXd& b) const {
  if (dense_) return dense_->solve(b);
  MatrixXd x(columns_, b.cols());
  for (Index j = 0; j < b.cols(); ++j) {
    const VectorXd step = sparse_->solve(VectorXd::Zero(columns_), b.col(j));
    if (step.size() == 0)
      x.col(j).setConstant(std::numeric_limits<double>::quiet_NaN());
    else
      x.col(j) = step;
  }
  return x;
}

}  // namespace courant
