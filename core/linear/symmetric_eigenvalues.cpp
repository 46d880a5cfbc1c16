#include "courant/core/linear/symmetric_eigenvalues.hpp"

#include <Eigen/Eigenvalues>
#include <stdexcept>
#include <string>

namespace courant {
namespace {

void check_square(const char* function, const Eigen::Ref<const Eigen::MatrixXd>& A) {
  if (A.rows() != A.cols())
    throw std::invalid_argument(std::string(function) + ": A is " + std::to_string(A.rows()) +
                                " × " + std::to_string(A.cols()) + "; expected a square matrix.");
}

}  // namespace

Eigen::VectorXd symmetric_eigenvalues(const Eigen::Ref<const Eigen::MatrixXd>& A) {
  check_square("symmetric_eigenvalues", A);
  if (A.rows() == 0) return Eigen::VectorXd(0);
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A, Eigen::EigenvaluesOnly).eigenvalues();
}

SymmetricEigenvectors symmetric_eigenvectors(const Eigen::Ref<const Eigen::MatrixXd>& A) {
  check_square("symmetric_eigenvectors", A);
  if (A.rows() == 0) return {Eigen::VectorXd(0), Eigen::MatrixXd(0, 0)};
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(A);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

}  // namespace courant
