// Derivatives of expressions, as expressions: they compose without limit.
#pragma once

#include <vector>

#include "courant/core/expressions/expr.hpp"

namespace courant {

// In all of these x are variables, each once (else std::invalid_argument); those that y doesn't
// contain count too. min, max and select have the derivative of the operand that they choose; the
// other one may be anything there, not a number included, in the value and in every derivative.

// ∇f (size n) for f: Rⁿ → R given at the variables x, by reverse mode: about as many operations as
// f has, whatever n is.
ExprVector gradient(const Expr& f, const ExprVector& x);

// The pull-back of the covector w by y: ∇_x ⟨w, y(x)⟩ (size n) for y: Rⁿ → Rᵐ and a weight w ∈ Rᵐ
// that is held fixed.
ExprVector pull_back(const ExprVector& y, const ExprVector& x, const ExprVector& w);

// The tangent map: d/ds y(x + s dx) at s = 0 (size m), by forward mode.
ExprVector tangent(const ExprVector& y, const ExprVector& x, const ExprVector& dx);

// The entries of a Jacobian that are not identically zero, sorted by row, then column.
struct SparseExprMatrix {
  Index rows = 0;
  Index cols = 0;
  std::vector<Index> row;  // row[k], col[k] hold values[k]
  std::vector<Index> col;
  ExprVector values;

  // The same matrix with its zeros.
  ExprMatrix dense() const;
};

// ∂y/∂x (m × n), by forward mode on sparse rows.
SparseExprMatrix jacobian(const ExprVector& y, const ExprVector& x);

// Whether y is written as an affine map of x: sums of terms each of which has one x, to the first power, times or over
// what has none. What jumps is not, though its derivative is constant, as that of sign is.
bool is_affine(const ExprVector& y, const ExprVector& x);

// y with the variables x replaced, all at once, by `replacement` (same size), which may be in
// another graph or constant. Parameters (graph_parameters.hpp) that are not among x become those of the
// other graph.
ExprVector substitute(const ExprVector& y, const ExprVector& x, const ExprVector& replacement);
Expr substitute(const Expr& y, const ExprVector& x, const ExprVector& replacement);

}  // namespace courant
