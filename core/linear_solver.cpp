#include "courant/core/linear_solver.hpp"

#include "courant/core/dense_solver.hpp"
#include "courant/core/sparse_solver.hpp"

namespace courant {

namespace {

// A SparseSolver for square matrices of at least so many columns and, of so many entries, at most one other
// than zero; else a DenseSolver.
std::unique_ptr<LinearSolver> sparse_from(Index columns, Index entries_for_one,
                                          const MatrixPattern& pattern, DenseSolver::Keeps keeps) {
  const auto entries = static_cast<Index>(pattern.row.size());
  if (pattern.rows == pattern.columns && pattern.columns >= columns &&
      entries * entries_for_one <= pattern.columns * pattern.columns)
    return std::make_unique<SparseSolver>(pattern);
  return std::make_unique<DenseSolver>(pattern, keeps);
}

}  // namespace

// Measured, see bench/README.md.
std::unique_ptr<LinearSolver> linear_solver(const MatrixPattern& pattern) {
  return sparse_from(64, 8, pattern, DenseSolver::Keeps::inverse);
}

// An inverse costs three times what its factors do, and those of 48 unknowns of four vortices fifty times
// what sparse factors do.
std::unique_ptr<LinearSolver> brief_linear_solver(const MatrixPattern& pattern) {
  return sparse_from(12, 4, pattern, DenseSolver::Keeps::factors);
}

}  // namespace courant
