#include "courant/integrators/step/step_solver.hpp"

#include <algorithm>
#include <cmath>

#include "courant/core/linear/pairs.hpp"
#include "courant/core/solve/unknown_selection.hpp"
#include "courant/core/words/message.hpp"

namespace courant {
namespace {

// Of the coordinates, a part that is no displacement. Of the sizes of displacements each step
// forgets so much.
constexpr double kNoDisplacement = 1e-10;
constexpr double kForgotten = 0.98;

// States of this size, as of a circuit whose pulse is long over, have so few digits that no curve can be
// followed from them, and go to zero whatever is taken for the next one.
constexpr double kFewDigits = 1e-290;

// What two ways to the same solution may differ by.
constexpr double kSameSolution = 1e-3;

// A curve of at most so many arcs, whose end is where it set out for up to this part of usual
// displacements, hardly bends.
constexpr int kFewArcs = 3;
constexpr double kHardlyBent = 0.1;

// To 24 bits.
void round_digits(VectorXd& y) {
  constexpr double least = 1e-30, most = 1e30;
  for (double& entry : y)
    if (std::fabs(entry) > least && std::fabs(entry) < most) entry = static_cast<float>(entry);
}

}  // namespace

StepSolver::StepSolver(const EquationSystem& equations, std::vector<Index> groups,
                       std::string method)
    : newton_(equations, std::move(groups), {}),
      y_(VectorXd::Zero(equations.size())),
      other_(y_),
      method_(std::move(method)) {}

StepSolver::StepSolver(const EquationSystem& equations, std::vector<Index> groups,
                       std::string method, const Function& whole,
                       const StepContinuation::Layout& layout)
    : StepSolver(equations, std::move(groups), std::move(method)) {
  if (whole.input_count() == 0) return;
  continuation_.emplace(whole, layout);
  equations_ = whole.output_size();
  unknowns_ = std::ssize(ContainedUnknowns(whole).places);
  usual_ = VectorXd::Zero(layout.displacements);
}

std::vector<Index> StepSolver::predicted() const {
  std::vector<Index> places = newton_.sought();
  for (Index i = 0; i < usual_.size(); ++i) places.push_back(i);
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

std::vector<Index> StepSolver::found() const {
  std::vector<Index> places;
  for (Index i = 0; i < y_.size(); ++i)
    if (!std::ranges::binary_search(newton_.left(), i)) places.push_back(i);
  return places;
}

Motion StepSolver::motion(const Manifold& manifold) const {
  Motion motion{.is_predictable = is_trusted_ && is_mild_, .displacements = usual_};
  if (manifold.dimension() < manifold.tangent_dimension())
    motion.displacements.setConstant(largest(usual_));
  return motion;
}

void StepSolver::expect(const Motion& motion) {
  is_expected_ = motion.is_predictable && motion.displacements.size() == usual_.size();
  if (!is_expected_) return;
  usual_ = motion.displacements;
  is_mild_ = true;
}

void StepSolver::keep() {
  is_trusted_ = is_good_;
  is_expected_ = false;
  usual_ = y_.head(usual_.size()).cwiseAbs().cwiseMax(kForgotten * usual_);
}

bool StepSolver::is_as_predicted(double part, double size) const {
  if (size > 0.0 && size < kFewDigits) return true;
  const double least = kNoDisplacement * size;
  bool result = true;
  for_each_pair(0, usual_.size(), [&]<class Numbers>(Index i, Numbers) {
    const Numbers y = read<Numbers>(y_.data() + i);
    const Numbers change = magnitude(Numbers(y - read<Numbers>(other_.data() + i)));
    const Numbers size = larger(Numbers(magnitude(y)), read<Numbers>(usual_.data() + i));
    result &= is_at_most(change, larger(Numbers(part * size), least));
  });
  return result;
}

// Whether displacements are those that the velocity of the state predicted, up to a part of their usual
// size: a coordinate may turn, which takes more arcs than one.
bool StepSolver::is_straight(const VectorXd& start) const {
  for (Index i = 0; i < usual_.size(); ++i)
    if (!(std::fabs(y_[i] - start[i]) <= kHardlyBent * std::max(std::fabs(y_[i]), usual_[i])))
      return false;
  return true;
}

bool StepSolver::is_same(double size) const {
  const Index count = usual_.size();
  const double least = count == 0 ? 0.0 : kSameSolution * y_.head(count).lpNorm<Eigen::Infinity>();
  for (Index i = 0; i < count; ++i) {
    const double change = std::fabs(y_[i] - other_[i]);
    if (!(change <= kSameSolution * (std::fabs(y_[i]) + least) + kNoDisplacement * size))
      return false;
  }
  return true;
}

// unknown() is what the state predicts; other_ is what the iteration found if it converged.
void StepSolver::connect(bool converged, const Inputs& in, const double* scales,
                         const Attempt& attempt, SolverStatistics& statistics) {
  ++statistics.confirmations;
  const VectorXd start = y_;
  const auto [arrived, reached, arcs, begins_at_state, iterations] =
      continuation_->follow(y_, in, scales[0], usual_);
  is_mild_ = arrived && (arcs == 1 || (arcs <= kFewArcs && is_straight(start)));
  statistics.iterations += iterations;
  statistics.factorizations += iterations;
  if (arrived && converged && is_same(scales[0])) {
    y_ = other_;  // not by a swap: in.unknowns() is the place of y_
    return;
  }
  newton_.reset();
  if (!arrived) {
    if (reached == 0.0) fail(attempt);
    throw SolveError(SolveError::Reason::disconnected, method_, attempt.time, attempt.h,
                     "has no solution that is connected to the state", {},
                     SolveError::Reach{.h = reached * attempt.h, .remedy = surplus()});
  }
  ++statistics.failures;
  // A curve that does not begin at the state may confirm what the iteration found; against it, it is no
  // evidence.
  if (converged && !begins_at_state) fail(attempt);
  other_ = y_;
  if (converges(in, scales, statistics)) {
    // Once more, from digits in which all ways to the solution agree: the bits do not depend on the curve.
    round_digits(y_);
    newton_.reset();
    if (converges(in, scales, statistics) && is_same(scales[0])) return;
  }
  newton_.reset();
  fail(attempt);
}

void StepSolver::fail(const Attempt& attempt) const {
  const Newton::Result& result = newton_.result();
  if (result.status == Newton::Status::singular)
    throw SolveError(SolveError::Reason::singular, method_, attempt.time, attempt.h,
                     "has a matrix that is not finite; the state is at or near a singular point.",
                     result.residuals);
  if (result.status == Newton::Status::converged)
    throw SolveError(SolveError::Reason::disconnected, method_, attempt.time, attempt.h,
                     "has a solution that cannot be followed from the state, and may be a wrong "
                     "one; the step is too large, or the state is at or near a singular point.");
  const std::string why = surplus();
  throw SolveError(
      SolveError::Reason::diverged, method_, attempt.time, attempt.h,
      "did not converge in " + std::to_string(result.iterations) + " iterations, residual " +
          number_text(result.residuals.empty() ? 0.0 : result.residuals.back()) +
          (why.empty() ? "; the step is too large, or the state comes near a singular point."
                       : ". " + why),
      result.residuals);
}

std::string StepSolver::surplus() const {
  if (equations_ <= unknowns_ || method_.starts_with("constrain-first")) return "";
  return "A step has " + std::to_string(equations_) + " equations for " +
         std::to_string(unknowns_) +
         " unknowns: equations of the system that follow from others may contradict them in a step "
         "of "
         "this method, whatever its size. Leave out what follows, or take a method that keeps to "
         "all "
         "of them (constrain-first).";
}

double auxiliary_scale(double auxiliary, double state) { return 1e7 * auxiliary + 1e-3 * state; }

double coordinate_scale(const State& before, double h, double besides) {
  const double given = std::max(largest(before.x), besides);
  return given > 0.0 ? given : std::fabs(h) * largest(before.v);
}

double largest(const VectorXd& x) {
  PairMaximum result;
  for_each_pair(0, x.size(), [&]<class Numbers>(Index i, Numbers) {
    result.add(Numbers(magnitude(read<Numbers>(x.data() + i))));
  });
  return result.value();
}

}  // namespace courant
