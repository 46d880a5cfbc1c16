#include "courant/core/solve/gauss_newton.hpp"

#include <cmath>
#include <limits>

#include "courant/core/linear/complete_orthogonal_decomposition.hpp"

namespace courant {

GaussNewtonResult gauss_newton(const std::function<VectorXd(const VectorXd& y)>& F,
                               const std::function<MatrixXd(const VectorXd& y)>& J,
                               const VectorXd& start, const GaussNewtonOptions& options) {
  GaussNewtonResult result{.y = start, .defect = std::numeric_limits<double>::infinity()};
  for (; result.iterations < options.max_iterations; ++result.iterations) {
    const VectorXd value = F(result.y);
    const double defect = value.size() == 0 ? 0.0 : value.lpNorm<Eigen::Infinity>();
    if (!std::isfinite(defect)) return result;
    const bool halves = defect < 0.5 * result.defect;
    result.defect = defect;
    result.converged = defect == 0.0 || (defect <= options.accepted && !halves);
    if (result.converged) return result;
    const MatrixXd jacobian = J(result.y);
    if (!jacobian.allFinite()) return result;
    result.y -= CompleteOrthogonalDecomposition(jacobian).solve(value);
  }
  return result;
}

}  // namespace courant
