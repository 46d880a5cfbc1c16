#include "courant/integrators/step_solver.hpp"

#include <sstream>

namespace courant {

StepSolver::StepSolver(const EquationSystem& equations, std::vector<Index> groups,
                       std::string method)
    : newton_(equations, std::move(groups), {}),
      y_(VectorXd::Zero(equations.size())),
      method_(std::move(method)) {}

void StepSolver::fail(const Attempt& attempt) const {
  if (result_.status == Newton::Status::singular)
    throw SolveError(SolveError::Reason::singular, method_, attempt.time, attempt.h,
                     "has a matrix that is not finite; the state is at or near a singular point.",
                     result_.residuals);
  std::ostringstream message;
  message << "did not converge in " << result_.iterations << " iterations, residual "
          << (result_.residuals.empty() ? 0.0 : result_.residuals.back())
          << "; the step is too large, or the state comes near a singular point.";
  throw SolveError(SolveError::Reason::diverged, method_, attempt.time, attempt.h, message.str(),
                   result_.residuals);
}

double auxiliary_scale(double auxiliary, double state) { return 1e7 * auxiliary + 1e-3 * state; }

double largest(const VectorXd& x) { return x.size() == 0 ? 0.0 : x.lpNorm<Eigen::Infinity>(); }

}  // namespace courant
