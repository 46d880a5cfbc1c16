#include "courant/integrators/round_off_projection.hpp"

#include <Eigen/Dense>
#include <limits>

namespace courant {

RoundOffProjection::RoundOffProjection(const Manifold& manifold) {
  Graph graph;
  const ExprVector x = graph.variables("x", manifold.ambient_dimension());
  constraint_ =
      Function("constraint", {{"x", x}}, manifold.constraint(x), {.differentiate = {"x"}});
}

void RoundOffProjection::apply(VectorXd& x) const {
  if (constraint_.output_size() == 0) return;
  const VectorXd defect = constraint_({x});
  const double negligible =
      4.0 * std::numeric_limits<double>::epsilon() * std::max(1.0, x.lpNorm<Eigen::Infinity>());
  if (defect.lpNorm<Eigen::Infinity>() <= negligible) return;
  x -= constraint_.jacobian({x}).completeOrthogonalDecomposition().solve(defect);
}

}  // namespace courant
