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

}  // namespace courant
