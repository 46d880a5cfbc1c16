#include "courant/core/linear/singular_value_decomposition.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <stdexcept>

#include "courant/core/linear/large_singular_values.hpp"

namespace courant {
namespace {

// Up to so many values by Eigen's rotations, three times as long as LAPACK takes for 24 of them. The bits of LAPACK's
// are those of the BLAS below it, which differ from processor to processor, and small matrices choose frames, projections
// and ranks of nearly every run.
constexpr Eigen::Index kSmall = 24;

SingularValueDecomposition decompose(const Eigen::Ref<const MatrixXd>& A, Vectors vectors) {
  const Eigen::Index m = A.rows(), n = A.cols(), least = std::min(m, n);
  const bool are_wanted = vectors == Vectors::all;
  SingularValueDecomposition svd{VectorXd(least), MatrixXd(), MatrixXd()};
  if (are_wanted) {
    svd.U.setIdentity(m, m);
    svd.V.setIdentity(n, n);
  }
  if (least == 0) return svd;
  if (!A.allFinite())
    throw std::domain_error(
        "singular_value_decomposition: the matrix has entries that are not finite; expected finite "
        "numbers.");
  return least > kSmall ? large_singular_values(A, vectors) : rotated_singular_values(A, vectors);
}

}  // namespace

// Right where the divide and conquer of Eigen 3.4 is not.
SingularValueDecomposition rotated_singular_values(const Eigen::Ref<const MatrixXd>& A,
                                                   Vectors vectors) {
  const Eigen::JacobiSVD<MatrixXd> svd(
      A, vectors == Vectors::all ? Eigen::ComputeFullU | Eigen::ComputeFullV : 0);
  if (vectors == Vectors::none) return {svd.singularValues(), MatrixXd(), MatrixXd()};
  return {svd.singularValues(), svd.matrixU(), svd.matrixV()};
}

SingularValueDecomposition singular_value_decomposition(const Eigen::Ref<const MatrixXd>& A) {
  return decompose(A, Vectors::all);
}

VectorXd singular_values(const Eigen::Ref<const MatrixXd>& A) {
  return decompose(A, Vectors::none).values;
}

}  // namespace courant
