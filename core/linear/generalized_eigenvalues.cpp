#include "courant/core/linear/generalized_eigenvalues.hpp"

#include <Eigen/Eigenvalues>
#include <stdexcept>
#include <string>

namespace courant {

GeneralizedEigenvalues generalized_eigenvalues(const Eigen::Ref<const Eigen::MatrixXd>& A,
                                               const Eigen::Ref<const Eigen::MatrixXd>& B) {
  if (A.rows() != A.cols() || B.rows() != B.cols() || A.rows() != B.rows())
    throw std::invalid_argument("generalized_eigenvalues: A is " + std::to_string(A.rows()) +
                                " × " + std::to_string(A.cols()) + " and B " +
                                std::to_string(B.rows()) + " × " + std::to_string(B.cols()) +
                                "; expected square matrices of one size.");
  if (A.rows() == 0) return {Eigen::VectorXcd(0), Eigen::VectorXd(0)};
  const Eigen::GeneralizedEigenSolver<Eigen::MatrixXd> eigen(A, B, false);
  return {eigen.alphas(), eigen.betas()};
}

}  // namespace courant
