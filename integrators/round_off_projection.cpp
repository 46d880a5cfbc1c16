#include "courant/integrators/round_off_projection.hpp"

#include <limits>

#include "courant/core/complete_orthogonal_decomposition.hpp"

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
  if (!all_.allFinite()) return;  // who made this x reports it
  // Equations of bundles repeat each other up to round-off: what is 1e-8 of the others is no
  // direction to move in.
  constexpr double data_error = 2e-11;
  x -= CompleteOrthogonalDecomposition(constraint_.dense_jacobian(all_), data_error)
           .solve(all_.head(count));
}

}  // namespace courant
