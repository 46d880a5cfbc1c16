#include "courant/reading/linear_spectrum.hpp"

#include <algorithm>
#include <cmath>

#include "courant/core/expressions/function.hpp"
#include "courant/core/linear/generalized_eigenvalues.hpp"

namespace courant {

double fastest_decay(const ImplicitSystem& system, const VectorXd& at) {
  constexpr Index most = 400;
  const Index n = at.size(), m = system.auxiliary_size(), size = n + m;
  if (size == 0 || size > most || system.equation_count() != size ||
      system.manifold()->tangent_dimension() != n)
    return 0.0;
  Graph graph;
  const ExprVector x = graph.variables("x", n), v = graph.variables("v", n),
                   z = graph.variables("z", m);
  const Function F("linear", {{"x", x}, {"z", z}, {"v", v}}, system.residual(x, v, z, Expr(0.0)),
                   {.differentiate = {"x", "z", "v"}});
  const MatrixXd J = F.jacobian({at, VectorXd::Zero(m), VectorXd::Zero(n)});
  if (!J.allFinite()) return 0.0;
  // F_(x,z) y + λ F_v x = 0, in rows of one size.
  MatrixXd A = J.leftCols(size), B = MatrixXd::Zero(size, size);
  B.leftCols(n) = -J.rightCols(n);
  for (Index i = 0; i < size; ++i) {
    const double scale = std::max(A.row(i).cwiseAbs().maxCoeff(), B.row(i).cwiseAbs().maxCoeff());
    if (scale == 0.0) continue;
    A.row(i) /= scale;
    B.row(i) /= scale;
  }
  const auto [alphas, betas] = generalized_eigenvalues(A, B);
  double fastest = 0.0;
  for (Index i = 0; i < size; ++i) {
    // λ = α/β; where β is round-off, λ is one of the algebraic equations.
    const double beta = std::abs(betas[i]), alpha = std::abs(alphas[i]);
    if (beta <= 1e-15 * alpha) continue;
    fastest = std::max(fastest, -alphas[i].real() / betas[i]);
  }
  return fastest;
}

}  // namespace courant
