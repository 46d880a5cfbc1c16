// The iteration that a stepper runs in every step: prediction, Newton's method, a second try, a
// clear failure.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "courant/core/solve/newton.hpp"
#include "courant/integrators/step/step_continuation.hpp"
#include "courant/integrators/step/stepper.hpp"

namespace courant {

// Solves the equations of one step after the other, or throws SolveError. Holds workspace; one
// object a trajectory.
class StepSolver {
 public:
  // `groups` as in Newton.
  StepSolver(const EquationSystem& equations, std::vector<Index> groups, std::string method);
  // The same for the equations of a step of h; `whole`: all of them, for all unknowns, or empty where
  // they are affine and have no solution but one.
  StepSolver(const EquationSystem& equations, std::vector<Index> groups, std::string method,
             const Function& whole, const StepContinuation::Layout& layout);

  VectorXd& unknown() { return y_; }
  const VectorXd& unknown() const { return y_; }
  // The unknowns that a prediction has to fill in: those that the iteration begins with, and the
  // displacements that the solution is compared with; or all that are found. Not those that no equation
  // contains: what is extrapolated from extrapolations grows. Ascending.
  std::vector<Index> predicted() const;
  std::vector<Index> found() const;
  bool is_determined() const { return newton_.is_determined(); }  // as of Newton
  // Whether the equations give all unknowns that they contain, whatever a prediction says.
  bool is_explicit() const { return newton_.sought().empty(); }
  // Whether unknown() matters beyond predicted(): where no equation contains an unknown, and where the last
  // matrix left something open.
  bool needs_start() const { return !newton_.left().empty() || !newton_.is_determined(); }

  // On return unknown(), whose place is in.unknowns(), solves the equations. `begin` puts there what a second
  // try begins with if the first fails, and a third one, by damped steps. `attempt` is named in the
  // message of a SolveError.
  struct Attempt {
    double time, h;
  };
  template <class Begin>
  void solve(const Inputs& in, const double* scales, const Begin& begin, const Attempt& attempt,
             SolverStatistics& statistics) {
    if (converges(in, scales, statistics)) return;
    ++statistics.failures;
    newton_.reset();
    begin();
    if (converges(in, scales, statistics)) return;
    newton_.reset();
    begin();
    if (newton_.approach(in, scales) && converges(in, scales, statistics)) return;
    newton_.reset();
    fail(attempt);
  }
  // The solution that is connected to the state. One close to what unknown() predicted is taken for it, every
  // displacement right to a twentieth of its size, if the matrix of an earlier step led there, or the last step was
  // predicted as well; right to a quarter after expect(); and to a thousandth where the equations of a step bend: where
  // the last curve that was followed was neither one arc nor, of few, one that ended where the velocity of the state
  // pointed to, or none was. Else it is the one that StepContinuation finds; `begin` puts into unknown() what the state
  // alone predicts.
  template <class Begin>
  void solve_connected(const Inputs& in, const double* scales, const Begin& begin,
                       const Attempt& attempt, SolverStatistics& statistics) {
    if (!continuation_) return solve(in, scales, begin, attempt, statistics);
    other_.head(usual_.size()) = y_.head(usual_.size());
    const bool converged = converges(in, scales, statistics);
    is_good_ = converged && is_as_predicted(allowed(), scales[0]);
    if (is_good_ && (is_trusted_ || newton_.result().factorizations == 0)) return;
    other_ = y_;
    begin();
    connect(converged, in, scales, attempt, statistics);
  }
  // As of Newton, for what unknown() predicts; y₀ is what the state alone predicts.
  void settle(const VectorXd& y0) { newton_.settle(y_, y0); }
  // The step that was solved stands.
  void keep();
  // The kept factorisation, and the sizes of displacements.
  void forget() {
    newton_.reset();
    usual_.setZero();
    is_trusted_ = true;
    is_mild_ = is_expected_ = false;
  }
  // As of Stepper. A basis of tangent vectors that is made afresh has other coordinates: where there
  // is one, all displacements have the size of the largest.
  Motion motion(const Manifold& manifold) const;
  void expect(const Motion& motion);

 private:
  bool converges(const Inputs& in, const double* scales, SolverStatistics& statistics) {
    const Newton::Result& result = newton_.solve(in, scales);
    statistics.iterations += result.iterations;
    statistics.factorizations += result.factorizations;
    return result.status == Newton::Status::converged;
  }
  // The part of its size that a displacement may differ from its prediction by.
  double allowed() const {
    return is_expected_ ? kExpected : is_mild_ ? kPredicted : kWellPredicted;
  }
  bool is_as_predicted(double part, double size) const;
  bool is_same(double size) const;
  bool is_straight(const VectorXd& start) const;
  void connect(bool converged, const Inputs& in, const double* scales, const Attempt& attempt,
               SolverStatistics& statistics);
  [[noreturn]] void fail(const Attempt& attempt) const;
  // Where there are more equations than unknowns: why they need not have a solution, and what to do.
  std::string surplus() const;

  // A displacement that is predicted up to this part of its size, or up to such a part of the
  // coordinates, needs no confirmation. Its size is the largest of the last steps, of which each
  // forgets a little: at a turning point of a coordinate a displacement is small.
  static constexpr double kPredicted = 0.05;
  static constexpr double kWellPredicted = 1e-3;
  // For a step that the velocity of the last one predicts, where that one was predicted.
  static constexpr double kExpected = 0.25;

  Newton newton_;
  VectorXd y_;
  VectorXd other_;  // the prediction, or another solution
  std::optional<StepContinuation> continuation_;
  Index equations_ = 0, unknowns_ = 0;  // of a step, where it is followed
  VectorXd usual_;                      // sizes of displacements
  bool is_good_ = false;                // the prediction of this step
  bool is_trusted_ = true;              // that of the last one was good
  bool is_mild_ = false;                // the last curve that was followed hardly bent
  bool is_expected_ = false;            // the next step goes on with a motion that is known
  std::string method_;
};

// The scale that Newton measures multipliers, port variables and jets by: they converge together
// with the state, so eight digits are asked for, and none of a value that is zero but for
// round-off.
double auxiliary_scale(double auxiliary, double state);

// What a step measures coordinates by: the largest of those of the state, and `besides`, a size of others. A start at zero,
// as of a circuit at rest, has the size of its first step.
double coordinate_scale(const State& before, double h, double besides = 0.0);

// ‖x‖_∞, 0 for an empty vector.
double largest(const VectorXd& x);

}  // namespace courant
