// How far a step is from a Poisson map, by differences.
#pragma once

#include "courant/integrators/step/integrator.hpp"
#include "courant/structures/lie_poisson.hpp"

namespace courant::test {

// x after so many steps of h.
inline VectorXd step(const Integrator& method, const VectorXd& x, double h, long count = 1) {
  return method.advance({.x = x}, h, count).x;
}

// The largest entry of DΦ Λ DΦᵀ - Λ ∘ Φ for a step Φ, DΦ by central differences of order 8 that go `e` far.
inline double bracket_defect(const Integrator& method, const LiePoisson& structure,
                             const VectorXd& x, double h, double e = 0.02) {
  const Index n = x.size();
  const double weights[] = {4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0};
  MatrixXd D = MatrixXd::Zero(n, n);
  for (Index j = 0; j < n; ++j)
    for (int k = 1; k <= 4; ++k) {
      const VectorXd shift = k * e * VectorXd::Unit(n, j);
      D.col(j) += weights[k - 1] / e * (step(method, x + shift, h) - step(method, x - shift, h));
    }
  const MatrixXd before = values(structure.bivector(constants(x)));
  const MatrixXd after = values(structure.bivector(constants(step(method, x, h))));
  return (D * before * D.transpose() - after).cwiseAbs().maxCoeff();
}

}  // namespace courant::test
