// Block matrices.
#pragma once

#include <Eigen/Core>

namespace courant {

// [A B]
inline Eigen::MatrixXd beside(const Eigen::Ref<const Eigen::MatrixXd>& A,
                              const Eigen::Ref<const Eigen::MatrixXd>& B) {
  Eigen::MatrixXd result(A.rows(), A.cols() + B.cols());
  result << A, B;
  return result;
}

// [A; B]
inline Eigen::MatrixXd above(const Eigen::Ref<const Eigen::MatrixXd>& A,
                             const Eigen::Ref<const Eigen::MatrixXd>& B) {
  Eigen::MatrixXd result(A.rows() + B.rows(), A.cols());
  result << A, B;
  return result;
}

// A with each of its first blocks of basis.rows() rows, tangent vectors or covectors s, as Bᵀ s in
// the basis B, followed by zeros up to `kept` rows.
template <class Matrix, class Basis>
Matrix with_blocks_in_basis(const Matrix& A, const Basis& basis, Eigen::Index blocks,
                            Eigen::Index kept) {
  const Eigen::Index full = basis.rows(), others = A.rows() - blocks * full;
  Matrix result = Matrix::Zero(blocks * kept + others, A.cols());
  for (Eigen::Index b = 0; b < blocks; ++b)
    result.middleRows(b * kept, basis.cols()) = basis.transpose() * A.middleRows(b * full, full);
  result.bottomRows(others) = A.bottomRows(others);
  return result;
}

}  // namespace courant
