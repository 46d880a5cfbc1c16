#include "courant/integrators/moving_basis.hpp"

#include "courant/integrators/local_formulation.hpp"

namespace courant {

Function MovingBasis::projection(const Manifold& manifold, Backend backend) {
  Graph graph;
  const ExprVector x = graph.variables("x", manifold.ambient_dimension());
  const ExprMatrix basis = basis_variables(graph, manifold);
  const ExprVector entries = basis_parameters(manifold, basis);
  const ExprVector projected = entries.size() == 0
                                   ? entries
                                   : ExprVector((manifold.tangent_projector(x) * basis).reshaped());
  return Function("basis", {{"x", x}, {"basis", entries}}, projected, {.backend = backend});
}

MovingBasis::MovingBasis(const Manifold& manifold, Function projection, const VectorXd& x)
    : manifold_(manifold),
      projection_(std::move(projection)),
      basis_(manifold.tangent_basis(x)),
      projected_(basis_),
      correction_(basis_.cols(), basis_.cols()) {}

void MovingBasis::move_to(const VectorXd& x) {
  if (projection_.output_size() == 0) return;
  const double* in[] = {x.data(), basis_.data()};
  projection_.value(in, projected_.data());
  // Newton and Schulz: P ← P (3 - PᵀP)/2 squares the defect, so that 1e-8 is the last one to see.
  double defect = 1.0;
  while (defect > 1e-8) {
    correction_ = -0.5 * projected_.transpose().lazyProduct(projected_);
    correction_.diagonal().array() += 0.5;
    defect = 2.0 * correction_.lpNorm<Eigen::Infinity>();
    if (!(defect < 0.5)) {
      basis_ = manifold_.tangent_basis(x);
      return;
    }
    correction_.diagonal().array() += 1.0;
    basis_ = projected_.lazyProduct(correction_);
    projected_.swap(basis_);
  }
  basis_.swap(projected_);
}

}  // namespace courant
