#include "courant/core/linear/solver_choice.hpp"

#include "courant/core/linear/dense_solver.hpp"
#include "courant/core/linear/sparse_solver.hpp"

namespace courant {

namespace {

// Square matrices of at least so many columns and, of so many entries, at most one other than zero.
bool is_sparse(const MatrixPattern& pattern, Index columns, Index entries_for_one) {
  const auto entries = static_cast<Index>(pattern.row.size());
  return pattern.rows == pattern.columns && pattern.columns >= columns &&
         entries * entries_for_one <= pattern.columns * pattern.columns;
}

std::unique_ptr<LinearSolver> solver_of(const MatrixPattern& pattern, bool is_sparse,
                                        DenseSolver::Keeps keeps) {
  if (is_sparse) return std::make_unique<SparseSolver>(pattern);
  return std::make_unique<DenseSolver>(pattern, keeps);
}

// An inverse costs three times what its factors do, and those of 48 unknowns of four vortices fifty times
// what sparse factors do.
bool is_briefly_sparse(const MatrixPattern& pattern) { return is_sparse(pattern, 12, 4); }

}  // namespace

// Measured, see bench/README.md.
std::unique_ptr<LinearSolver> linear_solver(const MatrixPattern& pattern) {
  return solver_of(pattern, is_sparse(pattern, 64, 8), DenseSolver::Keeps::inverse);
}

std::unique_ptr<LinearSolver> brief_linear_solver(const MatrixPattern& pattern) {
  return solver_of(pattern, is_briefly_sparse(pattern), DenseSolver::Keeps::factors);
}

bool has_plain_factors(const MatrixPattern& pattern) {
  return pattern.rows == pattern.columns && pattern.rows <= LuDecomposition::kPlain &&
         !is_briefly_sparse(pattern);
}

}  // namespace courant
