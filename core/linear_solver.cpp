#include "courant/core/linear_solver.hpp"

#include "courant/core/dense_solver.hpp"
#include "courant/core/sparse_solver.hpp"

namespace courant {

std::unique_ptr<LinearSolver> linear_solver(const MatrixPattern& pattern) {
  // Measured, see bench/README.md.
  constexpr Index least = 64, fewest_columns_an_entry = 8;
  const auto entries = static_cast<Index>(pattern.row.size());
  if (pattern.rows == pattern.columns && pattern.columns >= least &&
      entries * fewest_columns_an_entry <= pattern.columns * pattern.columns)
    return std::make_unique<SparseSolver>(pattern);
  return std::make_unique<DenseSolver>(pattern);
}

}  // namespace courant
