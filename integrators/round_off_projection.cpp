#include "courant/integrators/round_off_projection.hpp"

#include <Eigen/Dense>
#include <limits>

namespace courant {

RoundOffProjection::RoundOffProjection(const Manifold& manifold) {
  Graph graph;
  const ExprVector x = graph.variables("x", manifold.ambient_dimension());
  constraint_ =
      Function("constraint", {{"x", x}}, manifold.constraint(x), {.differentiate = {"x"}});
  all_.resize(constraint_.output_size() + constraint_.nonzeros());
  jacobian_.setZero(constraint_.output_size(), constraint_.jacobian_cols());
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
  for (std::size_t k = 0; k < constraint_.pattern_row().size(); ++k)
    jacobian_(constraint_.pattern_row()[k], constraint_.pattern_col()[k]) =
        all_[count + static_cast<Index>(k)];
  x -= jacobian_.completeOrthogonalDecomposition().solve(all_.head(count));
}

}  // namespace courant
