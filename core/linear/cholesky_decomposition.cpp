#include "courant/core/linear/cholesky_decomposition.hpp"

#include <Eigen/Cholesky>
#include <stdexcept>
#include <string>

namespace courant {

CholeskyDecomposition::CholeskyDecomposition(const Eigen::Ref<const MatrixXd>& A) {
  if (A.rows() != A.cols())
    throw std::invalid_argument("CholeskyDecomposition::CholeskyDecomposition: A is " +
                                std::to_string(A.rows()) + " × " + std::to_string(A.cols()) +
                                "; expected a square matrix.");
  const Eigen::LLT<MatrixXd> decomposition(A);
  L_ = decomposition.matrixL();
  // Eigen finds no fault with a pivot that is not a number.
  is_positive_definite_ = decomposition.info() == Eigen::Success && L_.allFinite();
}

MatrixXd CholeskyDecomposition::solve_lower(const Eigen::Ref<const MatrixXd>& B) const {
  if (B.rows() != L_.rows())
    throw std::invalid_argument("CholeskyDecomposition::solve_lower: B has " +
                                std::to_string(B.rows()) + " rows, expected " +
                                std::to_string(L_.rows()) + ".");
  return L_.triangularView<Eigen::Lower>().solve(B);
}

MatrixXd semidefinite_solution(const Eigen::Ref<const MatrixXd>& A,
                               const Eigen::Ref<const MatrixXd>& B) {
  if (A.rows() != A.cols() || B.rows() != A.rows())
    throw std::invalid_argument("semidefinite_solution: A is " + std::to_string(A.rows()) + " × " +
                                std::to_string(A.cols()) + " and B has " +
                                std::to_string(B.rows()) +
                                " rows; expected a square matrix, and as many.");
  return Eigen::LDLT<MatrixXd>(A).solve(B);
}

}  // namespace courant
