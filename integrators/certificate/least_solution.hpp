// LeastSolution: the least solutions of A x = b that steps and tangent directions are made of.
#pragma once

#include <optional>

#include "courant/core/linear/complete_orthogonal_decomposition.hpp"
#include "courant/integrators/certificate/saddle_point.hpp"

namespace courant {

// x of least norm, of those that leave the least of A x - b, for a matrix whose entries are alike. What is below 10⁻¹¹
// of the largest pivot is not divided by. Up to 200 rows and columns by an orthogonal factorisation; others by a sparse
// one of A Aᵀ + 10⁻¹⁶, which is exact to 10⁻¹⁶ / σ² in the direction of a singular value σ: an iteration makes that
// good.
class LeastSolution {
 public:
  explicit LeastSolution(const SparseMatrixXd& A);

  // Column by column; NaN where a factorisation broke down.
  MatrixXd solve(const MatrixXd& b) const;

 private:
  Index columns_;
  std::optional<CompleteOrthogonalDecomposition> dense_;
  std::optional<SaddlePoint> sparse_;
};

}  // namespace courant
