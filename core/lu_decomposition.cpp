#include "courant/core/lu_decomposition.hpp"

#include <Eigen/LU>
#include <stdexcept>
#include <string>

namespace courant {

LuDecomposition::LuDecomposition(const Eigen::Ref<const MatrixXd>& A) : factors_(A), rows_(0) {
  if (A.rows() != A.cols())
    throw std::invalid_argument("LuDecomposition::LuDecomposition: A is " +
                                std::to_string(A.rows()) + " × " + std::to_string(A.cols()) +
                                "; expected a square matrix.");
  if (size() == 0) return;
  const Eigen::PartialPivLU<Eigen::Ref<MatrixXd>> in_place(factors_);
  rows_ = in_place.permutationP();
}

double LuDecomposition::pivot_ratio() const {
  if (size() == 0) return 1.0;
  const VectorXd pivots = factors_.diagonal().cwiseAbs();
  const double largest = pivots.maxCoeff();
  return largest > 0.0 ? pivots.minCoeff() / largest : 0.0;
}

double LuDecomposition::determinant() const {
  double result = static_cast<double>(rows_.determinant());
  for (const double pivot : factors_.diagonal()) result *= pivot;
  return result;
}

int LuDecomposition::orientation() const {
  int result = size() == 0 ? 1 : static_cast<int>(rows_.determinant());
  for (const double pivot : factors_.diagonal()) result *= pivot > 0.0 ? 1 : pivot < 0.0 ? -1 : 0;
  return result;
}

MatrixXd LuDecomposition::solve(const Eigen::Ref<const MatrixXd>& B) const {
  if (B.rows() != size())
    throw std::invalid_argument("LuDecomposition::solve: B has " + std::to_string(B.rows()) +
                                " rows, expected " + std::to_string(size()) + ".");
  MatrixXd result = rows_ * B;
  factors_.triangularView<Eigen::UnitLower>().solveInPlace(result);
  factors_.triangularView<Eigen::Upper>().solveInPlace(result);
  return result;
}

MatrixXd LuDecomposition::inverse() const { return solve(MatrixXd::Identity(size(), size())); }

}  // namespace courant
