// The eigenvalues of a symmetric matrix.
#pragma once

#include <Eigen/Core>

namespace courant {

// Increasing, of the symmetric matrix with the lower triangle of A (n × n, n ≥ 0).
Eigen::VectorXd symmetric_eigenvalues(const Eigen::Ref<const Eigen::MatrixXd>& A);

}  // namespace courant
