#include "courant/core/linear/symmetric_eigenvalues.hpp"

#include <Eigen/Eigenvalues>
#include <stdexcept>
#include <string>

namespace courant {

Eigen::VectorXd symmetric_eigenvalues(const Eigen::Ref<const Eigen::MatrixXd>& A) {
  if (A.rows() != A.cols())
    throw std::invalid_argument("symmetric_eigenvalues: A is " + std::to_string(A.rows()) + " × " +
                                std::to_string(A.cols()) + "; expected a square matrix.");
  if (A.rows() == 0) return Eigen::VectorXd(0);
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A, Eigen::EigenvaluesOnly).eigenvalues();
}

}  // namespace courant
