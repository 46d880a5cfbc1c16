// The eigenvalues and eigenvectors of a symmetric matrix.
#pragma once

#include <Eigen/Core>

namespace courant {

// Increasing, of the symmetric matrix with the lower triangle of A (n × n, n ≥ 0). Both throw std::invalid_argument if
// A is not square.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::Ref<const Eigen::MatrixXd>& A);

// A = Q diag(values) Qᵀ, values increasing, Q (n × n) orthogonal.
struct SymmetricEigenvectors {
  Eigen::VectorXd values;
  Eigen::MatrixXd Q;
};
SymmetricEigenvectors symmetric_eigenvectors(const Eigen::Ref<const Eigen::MatrixXd>& A);

}  // namespace courant
