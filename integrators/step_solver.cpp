#include "courant/integrators/step_solver.hpp"

#include <sstream>

namespace courant {

StepSolver::StepSolver(const Function& equations, std::vector<Index> groups, std::string method)
    : newton_(equations, std::move(groups), {}),
      y_(VectorXd::Zero(equations.input_size(0))),
      method_(std::move(method)) {}

void StepSolver::solve(const double* const* in, const double* scales, const VectorXd& start,
                       const State& last, SolverStatistics& statistics) {
  Newton::Result result;
  for (int attempt = 0; attempt < 2; ++attempt) {
    if (attempt == 1) {
      ++statistics.failures;
      newton_.reset();
      y_ = start;
    }
    result = newton_.solve(y_.data(), in, scales);
    statistics.iterations += result.iterations;
    statistics.factorizations += result.factorizations;
    if (result.status == Newton::Status::converged) return;
  }
  newton_.reset();
  const bool singular = result.status == Newton::Status::singular;
  std::ostringstream message;
  message << method_ << ": step " << statistics.steps + 1 << " from t = " << last.t;
  if (singular)
    message << " has a matrix that is not finite; the state is at or near a singular point.";
  else
    message << " did not converge in " << result.iterations << " iterations, residual "
            << (result.residuals.empty() ? 0.0 : result.residuals.back())
            << "; the step is too large, or the state comes near a singular point.";
  throw SolveError(singular ? SolveError::Reason::singular : SolveError::Reason::diverged, last.t,
                   statistics.steps + 1, result.residuals, message.str());
}

double auxiliary_scale(double auxiliary, double state) { return 1e7 * auxiliary + 1e-3 * state; }

double largest(const VectorXd& x) { return x.size() == 0 ? 0.0 : x.lpNorm<Eigen::Infinity>(); }

}  // namespace courant
