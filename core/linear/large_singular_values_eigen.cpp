#include "courant/core/linear/large_singular_values.hpp"

namespace courant {

SingularValueDecomposition large_singular_values(const Eigen::Ref<const MatrixXd>& A,
                                                 Vectors vectors) {
  return rotated_singular_values(A, vectors);
}

}  // namespace courant
