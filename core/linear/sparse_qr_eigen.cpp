#include <Eigen/SparseQR>
#include <cmath>
#include <stdexcept>
#include <string>

#include "courant/core/linear/sparse_qr.hpp"

namespace courant {

SparseQr sparse_qr(const Eigen::SparseMatrix<double>& A, double tolerance) {
  using Matrix = Eigen::SparseMatrix<double>;
  if (A.rows() == 0 || A.cols() == 0) return {Matrix(0, 0), Matrix(0, A.cols()), 0.0};
  Matrix matrix = A;
  matrix.makeCompressed();
  Eigen::SparseQR<Matrix, Eigen::COLAMDOrdering<int>> qr;
  qr.setPivotThreshold(tolerance);
  qr.compute(matrix);
  if (qr.info() != Eigen::Success)
    throw std::runtime_error("sparse_qr: Eigen's SparseQR failed on a " + std::to_string(A.rows()) +
                             " × " + std::to_string(A.cols()) +
                             " matrix: " + qr.lastErrorMessage());
  const Eigen::Index n = A.cols(), r = qr.rank();
  const Matrix trapezoid = qr.matrixR();
  SparseQr result{trapezoid.topLeftCorner(r, r), trapezoid.topRightCorner(r, n - r), 0.0};
  // Eigen forgets what it drops: the tails of the columns that it took for dependent.
  const auto& order = qr.colsPermutation().indices();
  double square = 0.0;
  for (Eigen::Index j = r; j < n; ++j) {
    const Eigen::VectorXd rotated =
        qr.matrixQ().transpose() * Eigen::VectorXd(matrix.col(order[j]));
    square += rotated.tail(A.rows() - r).squaredNorm();
  }
  result.dropped = std::sqrt(square);
  return result;
}

}  // namespace courant
