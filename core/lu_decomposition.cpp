#include "courant/core/lu_decomposition.hpp"

#include <Eigen/LU>
#include <cmath>
#include <stdexcept>
#include <string>

namespace courant {
namespace {

// Up to this size by plain loops, whose order of operations programs in C repeat (c_program): they cost
// about as much as blocks do. Beyond it by blocks.
constexpr Index kPlain = 63;

// P A = L U in place.
Eigen::PermutationMatrix<Eigen::Dynamic> factorize(MatrixXd& A) {
  const Index n = A.rows();
  Eigen::Transpositions<Eigen::Dynamic> exchanges(n);
  for (Index k = 0; k < n; ++k) {
    double* const factor = A.col(k).data();
    Index pivot = k;
    for (Index i = k + 1; i < n; ++i)
      if (std::fabs(factor[i]) > std::fabs(factor[pivot])) pivot = i;
    exchanges.coeffRef(k) = static_cast<int>(pivot);
    if (factor[pivot] != 0.0) {
      if (pivot != k) A.row(k).swap(A.row(pivot));
      for (Index i = k + 1; i < n; ++i) factor[i] /= factor[k];
    }
    for (Index j = k + 1; j < n; ++j) {
      double* const column = A.col(j).data();
      for (Index i = k + 1; i < n; ++i) column[i] -= factor[i] * column[k];
    }
  }
  return Eigen::PermutationMatrix<Eigen::Dynamic>(exchanges);
}

}  // namespace

LuDecomposition::LuDecomposition(const Eigen::Ref<const MatrixXd>& A) : factors_(A), rows_(0) {
  if (A.rows() != A.cols())
    throw std::invalid_argument("LuDecomposition::LuDecomposition: A is " +
                                std::to_string(A.rows()) + " × " + std::to_string(A.cols()) +
                                "; expected a square matrix.");
  if (size() == 0) return;
  if (size() <= kPlain) {
    rows_ = factorize(factors_);
    return;
  }
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

// Column by column, each by axpys in the order of the factors: little matrices are done in less time than
// by blocks.
MatrixXd LuDecomposition::inverse() const {
  const Index n = size();
  if (n > kPlain) return solve(MatrixXd::Identity(n, n));
  MatrixXd result = rows_ * MatrixXd::Identity(n, n);
  for (Index j = 0; j < n; ++j) {
    double* const x = result.col(j).data();
    for (Index k = 0; k < n; ++k) {
      const double* const factor = factors_.col(k).data();
      for (Index i = k + 1; i < n; ++i) x[i] -= factor[i] * x[k];
    }
    for (Index k = n; k-- > 0;) {
      const double* const factor = factors_.col(k).data();
      x[k] /= factor[k];
      for (Index i = 0; i < k; ++i) x[i] -= factor[i] * x[k];
    }
  }
  return result;
}

}  // namespace courant
