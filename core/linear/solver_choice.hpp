// Which linear solver a pattern is best solved with.
#pragma once

#include <memory>

#include "courant/core/linear/linear_solver.hpp"

namespace courant {

// The solver that is faster for the pattern: a DenseSolver, or from some hundred unknowns on, if most
// entries are missing, a SparseSolver.
std::unique_ptr<LinearSolver> linear_solver(const MatrixPattern& pattern);

// The one that is faster where each matrix serves one or two right sides: a SparseSolver from a dozen
// unknowns on, if most entries are missing.
std::unique_ptr<LinearSolver> brief_linear_solver(const MatrixPattern& pattern);
// Whether that one keeps the factors of a regular matrix by plain loops, which programs in C repeat, to the last bit.
bool has_plain_factors(const MatrixPattern& pattern);

}  // namespace courant
