// The iteration that a stepper runs in every step: prediction, Newton's method, a second try, a
// clear failure.
#pragma once

#include <string>
#include <vector>

#include "courant/core/newton.hpp"
#include "courant/integrators/stepper.hpp"

namespace courant {

// Solves the equations of one step after the other, or throws SolveError. Holds workspace; one
// object a trajectory.
class StepSolver {
 public:
  // `groups` as in Newton.
  StepSolver(const EquationSystem& equations, std::vector<Index> groups, std::string method);

  VectorXd& unknown() { return y_; }
  const VectorXd& unknown() const { return y_; }
  const std::vector<Index>& kept() const { return newton_.kept(); }  // as of Newton
  bool is_determined() const { return newton_.is_determined(); }     // as of Newton

  // On return unknown() solves the equations; in[0] is its place. `begin` puts there what a second
  // try begins with if the first fails. `attempt` is named in the message of a SolveError.
  struct Attempt {
    double time, h;
  };
  template <class Begin>
  void solve(const double* const* in, const double* scales, const Begin& begin,
             const Attempt& attempt, SolverStatistics& statistics) {
    if (converges(in, scales, statistics)) return;
    ++statistics.failures;
    newton_.reset();
    begin();
    if (converges(in, scales, statistics)) return;
    newton_.reset();
    fail(attempt);
  }
  // The kept factorisation.
  void forget() { newton_.reset(); }

 private:
  bool converges(const double* const* in, const double* scales, SolverStatistics& statistics) {
    result_ = newton_.solve(y_.data(), in, scales);
    statistics.iterations += result_.iterations;
    statistics.factorizations += result_.factorizations;
    return result_.status == Newton::Status::converged;
  }
  [[noreturn]] void fail(const Attempt& attempt) const;

  Newton newton_;
  Newton::Result result_;
  VectorXd y_;
  std::string method_;
};

// The scale that Newton measures multipliers, port variables and jets by: they converge together
// with the state, so eight digits are asked for, and none of a value that is zero but for
// round-off.
double auxiliary_scale(double auxiliary, double state);

// ‖x‖_∞, 0 for an empty vector.
double largest(const VectorXd& x);

}  // namespace courant
