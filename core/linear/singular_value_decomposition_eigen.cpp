#include "courant/core/linear/jacobi_rotations.hpp"

namespace courant {

SingularValueDecomposition singular_value_decomposition(const Eigen::Ref<const MatrixXd>& A) {
  return by_rotations(A, true);
}

VectorXd singular_values(const Eigen::Ref<const MatrixXd>& A) {
  return by_rotations(A, false).values;
}

}  // namespace courant
