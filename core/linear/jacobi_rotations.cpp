#include "courant/core/linear/jacobi_rotations.hpp"

#include <Eigen/SVD>
#include <stdexcept>

namespace courant {

SingularValueDecomposition by_rotations(const Eigen::Ref<const MatrixXd>& A, bool is_whole) {
  const Eigen::Index m = A.rows(), n = A.cols();
  if (m == 0 || n == 0) {
    if (!is_whole) return {VectorXd(0), MatrixXd(), MatrixXd()};
    return {VectorXd(0), MatrixXd::Identity(m, m), MatrixXd::Identity(n, n)};
  }
  if (!A.allFinite())
    throw std::domain_error(
        "singular_value_decomposition: the matrix has entries that are not finite; expected finite "
        "numbers.");
  const unsigned int wanted = Eigen::ComputeFullU | Eigen::ComputeFullV;
  const Eigen::JacobiSVD<MatrixXd> svd(A, is_whole ? wanted : 0U);
  if (!is_whole) return {svd.singularValues(), MatrixXd(), MatrixXd()};
  return {svd.singularValues(), svd.matrixU(), svd.matrixV()};
}

}  // namespace courant
