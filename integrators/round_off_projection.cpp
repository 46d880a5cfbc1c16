#include "courant/integrators/round_off_projection.hpp"

#include <Eigen/Dense>
#include <limits>

namespace courant {

Function RoundOffProjection::constraint(const Manifold& manifold, Backend backend) {
  Graph graph;
  const ExprVector x = graph.variables("x", manifold.ambient_dimension());
  return Function("constraint", {{"x", x}}, manifold.constraint(x),
                  {.differentiate = {"x"}, .backend = backend});
}

RoundOffProjection::RoundOffProjection(Function constraint) : constraint_(std::move(constraint)) {
  all_.resize(constraint_.output_size() + constraint_.nonzeros());
}

void RoundOffProjection::apply(VectorXd& x) {
  const Index count = constraint_.output_size();
  if (count == 0) return;
  const double* in[] = {x.data()};
  constraint_.value(in, all_.data());
  const double negligible =
      32.0 * std::numeric_limits<double>::epsilon() * std::max(1.0, x.squaredNorm());
  if (all_.head(count).lpNorm<Eigen::Infinity>() <= negligible) return;
  constraint_.value_and_jacobian(in, all_.data());
  // Equations of bundles repeat each other up to round-off: what is 1e-8 of the others is no
  // direction to move in.
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> decomposition;
  decomposition.setThreshold(1e-8);
  decomposition.compute(constraint_.dense_jacobian(all_));
  x -= decomposition.solve(all_.head(count));
}

}  // namespace courant
