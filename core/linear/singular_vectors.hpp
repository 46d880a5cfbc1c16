// What a singular value decomposition consists of.
#pragma once

#include <Eigen/Core>

namespace courant {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// A = U diag(σ) Vᵀ, A of size m × n: σ₁ ≥ σ₂ ≥ … ≥ 0, min(m, n) values; U (m × m) and V (n × n)
// orthogonal. Sizes may be 0.
struct SingularValueDecomposition {
  VectorXd values;
  MatrixXd U, V;
};

enum class Vectors { none, all };  // which are asked for; U and V are empty without

}  // namespace courant
