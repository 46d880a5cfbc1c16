#include <Eigen/SVD>

#include "courant/core/linear/singular_value_decomposition.hpp"

namespace courant {
namespace {

// By Jacobi rotations: slower than divide and conquer, and right where that of Eigen 3.4 is not.
SingularValueDecomposition decompose(const Eigen::Ref<const MatrixXd>& A, unsigned int options) {
  const Eigen::Index m = A.rows(), n = A.cols();
  if (m == 0 || n == 0) return {VectorXd(0), MatrixXd::Identity(m, m), MatrixXd::Identity(n, n)};
  const Eigen::JacobiSVD<MatrixXd> svd(A, options);
  if (options == 0) return {svd.singularValues(), MatrixXd(), MatrixXd()};
  return {svd.singularValues(), svd.matrixU(), svd.matrixV()};
}

}  // namespace

SingularValueDecomposition singular_value_decomposition(const Eigen::Ref<const MatrixXd>& A) {
  return decompose(A, Eigen::ComputeFullU | Eigen::ComputeFullV);
}

VectorXd singular_values(const Eigen::Ref<const MatrixXd>& A) { return decompose(A, 0).values; }

}  // namespace courant
