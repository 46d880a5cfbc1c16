// The eigenvalues of a pencil of matrices.
#pragma once

#include <Eigen/Core>

namespace courant {

// λ_i = α_i / β_i with A y = λ B y for some y ≠ 0, A and B n × n: pairs that are found without a division, since λ is
// infinite where β is 0 and arbitrary where both are.
struct GeneralizedEigenvalues {
  Eigen::VectorXcd alphas;
  Eigen::VectorXd betas;
};

// By QZ, of the balanced pencil. Throws std::invalid_argument unless A and B are square and of one size,
// std::domain_error where an entry is not finite, std::runtime_error where the iteration does not end.
GeneralizedEigenvalues generalized_eigenvalues(const Eigen::Ref<const Eigen::MatrixXd>& A,
                                               const Eigen::Ref<const Eigen::MatrixXd>& B);

}  // namespace courant
