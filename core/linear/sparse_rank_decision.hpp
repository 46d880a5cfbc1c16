// The rank of a sparse matrix.
#pragma once

#include <Eigen/SparseCore>

#include "courant/core/linear/rank_decision.hpp"

namespace courant {

using SparseMatrixXd = Eigen::SparseMatrix<double>;

// The rank of a sparse matrix, by a rank-revealing sparse QR: A E = Q [R W; 0 δ], with R square and triangular.
// QR looks at the diagonal of R only; a triangle can be singular with ones on it. So the smallest
// singular values of R are computed too, by inverse iteration, and what W adds in their directions:
// they bound σ_r from below (to about 5 %), and together with δ they bound σ_{r+1} from above; where
// r = min(m, n) there is none, and δ lowers the bound of σ_r. The
// gap is that of the dense decision or less. If R⁻¹ overflows, the decision is ambiguous with gap
// 0.
RankDecision decide_rank(const SparseMatrixXd& A, const RankOptions& options = {});

}  // namespace courant
