#include "courant/integrators/step_solver.hpp"

#include <sstream>

namespace courant {

Predictor::Predictor(const Manifold& manifold, Index blocks, Index size)
    : constant_basis_(manifold.dimension() == manifold.tangent_dimension()),
      coordinates_(manifold.dimension()),
      tangents_(manifold.tangent_dimension()),
      blocks_(blocks) {
  extrapolated_ = VectorXd::Zero(size + blocks * (tangents_ - coordinates_));
  for (VectorXd& entry : history_) entry = extrapolated_;
}

void Predictor::predict(const MatrixXd& basis, VectorXd& y) {
  const VectorXd& last = history_[newest_];
  const VectorXd& before = history_[(newest_ + 2) % 3];
  const VectorXd& first = history_[(newest_ + 1) % 3];
  VectorXd& target = constant_basis_ ? y : extrapolated_;
  if (count_ == 0)
    target.setZero();
  else if (count_ == 1)
    target = last;
  else if (count_ == 2)
    target = 2.0 * last - before;
  else
    target = 3.0 * (last - before) + first;
  if (constant_basis_) return;
  for (Index b = 0; b < blocks_; ++b)
    y.segment(b * coordinates_, coordinates_).noalias() =
        basis.transpose() * extrapolated_.segment(b * tangents_, tangents_);
  const Index others = y.size() - blocks_ * coordinates_;
  y.tail(others) = extrapolated_.tail(others);
}

void Predictor::record(const MatrixXd& basis, const VectorXd& y) {
  newest_ = (newest_ + 1) % 3;
  if (count_ < 3) ++count_;
  VectorXd& entry = history_[newest_];
  if (constant_basis_) {
    entry = y;
    return;
  }
  for (Index b = 0; b < blocks_; ++b)
    entry.segment(b * tangents_, tangents_).noalias() =
        basis * y.segment(b * coordinates_, coordinates_);
  const Index others = y.size() - blocks_ * coordinates_;
  entry.tail(others) = y.tail(others);
}

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
