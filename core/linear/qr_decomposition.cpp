#include "courant/core/linear/qr_decomposition.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

namespace courant {

QrDecomposition::QrDecomposition(const Eigen::Ref<const MatrixXd>& A, bool pivots)
    : factors_(A), order_(static_cast<std::size_t>(A.cols())) {
  std::iota(order_.begin(), order_.end(), Index{0});
  if (A.size() == 0) return;
  if (pivots) {
    const Eigen::ColPivHouseholderQR<Eigen::Ref<MatrixXd>> in_place(factors_);
    coefficients_ = in_place.hCoeffs();
    const auto& order = in_place.colsPermutation().indices();
    std::copy(order.begin(), order.end(), order_.begin());
  } else {
    const Eigen::HouseholderQR<Eigen::Ref<MatrixXd>> in_place(factors_);
    coefficients_ = in_place.hCoeffs();
  }
}

QrDecomposition QrDecomposition::in_order(const Eigen::Ref<const MatrixXd>& A) {
  return QrDecomposition(A, false);
}

QrDecomposition QrDecomposition::pivoted(const Eigen::Ref<const MatrixXd>& A) {
  return QrDecomposition(A, true);
}

MatrixXd QrDecomposition::R(Index k) const {
  MatrixXd result = factors_.topRows(k);
  for (Index i = 1; i < k; ++i) result.row(i).head(std::min(i, cols())).setZero();
  return result;
}

MatrixXd QrDecomposition::Q(Index k) const { return product(MatrixXd::Identity(rows(), k)); }

MatrixXd QrDecomposition::product(const Eigen::Ref<const MatrixXd>& B) const {
  MatrixXd result = B;
  result.applyOnTheLeft(Eigen::householderSequence(factors_, coefficients_));
  return result;
}

MatrixXd QrDecomposition::transposed_product(const Eigen::Ref<const MatrixXd>& B) const {
  MatrixXd result = B;
  result.applyOnTheLeft(Eigen::householderSequence(factors_, coefficients_).transpose());
  return result;
}

MatrixXd QrDecomposition::solve(const Eigen::Ref<const MatrixXd>& B) const {
  const Index n = cols();
  if (B.rows() != rows() || n > rows())
    throw std::invalid_argument("QrDecomposition::solve: A is " + std::to_string(rows()) + " × " +
                                std::to_string(n) + " and B has " + std::to_string(B.rows()) +
                                " rows; expected as many as A, and no more columns than rows.");
  MatrixXd solution = transposed_product(B).topRows(n);
  factors_.topRows(n).triangularView<Eigen::Upper>().solveInPlace(solution);
  MatrixXd result(n, B.cols());
  for (Index j = 0; j < n; ++j) result.row(order_[static_cast<std::size_t>(j)]) = solution.row(j);
  return result;
}

MatrixXd orthonormalized(const Eigen::Ref<const MatrixXd>& A) {
  return QrDecomposition::in_order(A).Q(A.cols());
}

}  // namespace courant
