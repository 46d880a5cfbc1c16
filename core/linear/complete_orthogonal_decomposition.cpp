#include "courant/core/linear/complete_orthogonal_decomposition.hpp"

#include <stdexcept>
#include <string>

#include "courant/core/linear/rank_cut.hpp"

namespace courant {
namespace {

const Eigen::Ref<const MatrixXd>& checked(const Eigen::Ref<const MatrixXd>& A) {
  if (!A.allFinite())
    throw std::domain_error(
        "CompleteOrthogonalDecomposition: the matrix has entries that are not finite numbers.");
  return A;
}

RankDecision decide(const QrDecomposition& qr, double data_error) {
  const VectorXd pivots = qr.diagonal().cwiseAbs();
  const double largest = pivots.size() > 0 ? pivots.maxCoeff() : 0.0;
  const NoiseLevel noise =
      noise_level(qr.rows(), qr.cols(), largest, {.data_error = data_error, .magnitude = largest});
  RankDecision decision;
  decision.rows = qr.rows();
  decision.columns = qr.cols();
  decision.singular_values = pivots;
  const Index rank = count_above_cut(pivots, noise);
  conclude(decision, rank, rank > 0 ? pivots[rank - 1] : 0.0,
           rank < pivots.size() ? pivots[rank] : 0.0, noise);
  return decision;
}

}  // namespace

CompleteOrthogonalDecomposition::CompleteOrthogonalDecomposition(
    const Eigen::Ref<const MatrixXd>& A, double data_error)
    : range_(QrDecomposition::pivoted(checked(A))),
      decision_(decide(range_, data_error)),
      T_(range_.R(rank())) {
  if (rank() == A.cols()) return;
  row_space_ = QrDecomposition::in_order(T_.transpose());
  T_ = row_space_.R(rank()).transpose();
}

MatrixXd CompleteOrthogonalDecomposition::solve(const Eigen::Ref<const MatrixXd>& B) const {
  if (B.rows() != range_.rows())
    throw std::invalid_argument("CompleteOrthogonalDecomposition::solve: B has " +
                                std::to_string(B.rows()) + " rows, expected " +
                                std::to_string(range_.rows()) + ".");
  const Index n = range_.cols(), r = rank();
  MatrixXd solution = MatrixXd::Zero(n, B.cols());
  solution.topRows(r) = range_.transposed_product(B).topRows(r);
  if (r == n) {
    T_.triangularView<Eigen::Upper>().solveInPlace(solution);
  } else {
    auto leading = solution.topRows(r);
    T_.triangularView<Eigen::Lower>().solveInPlace(leading);
    solution = row_space_.product(solution);
  }
  MatrixXd result(n, B.cols());
  for (Index j = 0; j < n; ++j) result.row(order()[static_cast<std::size_t>(j)]) = solution.row(j);
  return result;
}

MatrixXd CompleteOrthogonalDecomposition::pseudo_inverse() const {
  return solve(MatrixXd::Identity(range_.rows(), range_.rows()));
}

}  // namespace courant
