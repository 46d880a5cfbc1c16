#include "courant/integrators/step/step_continuation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "courant/core/linear/solver_choice.hpp"
#include "courant/core/solve/damped_newton.hpp"
#include "courant/core/solve/unknown_selection.hpp"

namespace courant {
namespace {

// Iterations that contract to a quarter in the second one do so because there is a solution within
// 4/3 of the first correction, and no other (Kantorovich).
constexpr double kContraction = 0.25;
constexpr int kMostIterations = 12;
// That alone finds other solutions too. A prediction is followed if it is wrong by no more than this
// part of a displacement.
constexpr double kNear = 0.1;

// An iteration that changes displacements by less has found them to twice as many digits; what is
// left is up to the iteration that takes over. Changes that are round-off of the coordinates count
// as found.
constexpr double kPathTolerance = 1e-4;
constexpr double kRoundOff = 1e-13;

// A displacement is measured by its own size, or by that which it had in the steps before, if that is larger: at a
// turning point of a coordinate a displacement is small, and of many coordinates one always turns. But not by less than
// these parts of the largest one and of the coordinates.
constexpr double kLeastOfAll = 1e-3;
constexpr double kLeastOfState = 1e-8;
// What is not a displacement is measured by its own size where damped steps need it, and by this part
// of the coordinates at least.
constexpr double kUnmeasured = 1e-3;

// The curve begins at this part of the step, where equations hardly bend and Newton's method finds
// their solution from anywhere; or at less, down to kShortest. But not so near that displacements are
// round-off of the coordinates, and multipliers, determined with 1/h², are nothing else: a
// displacement is kSeen of them, and never less than kUnseen of that; but the curve begins no farther
// than kFarthest.
constexpr double kBeginning = 1e-3;
constexpr double kFarthest = 0.1;
constexpr double kSeen = 1e-6;
constexpr double kUnseen = 1e-2;
constexpr double kShortest = 1e-12;
// The curve ends where σ can grow by less than this part.
constexpr double kEnd = 1e-4;

// An arc of a curve whose tangents are t₀, t₁ at ends that are Δσ apart leaves the first tangent by
//
//   e = (t₁ - t₀) Δσ / 2
//
// as long as it bends one way. Two branches do not know of each other's tangents. What e is wrong by,
// next to its size; a part of a displacement that is no matter.
constexpr double kOtherBend = 0.5;
constexpr double kStraight = 1e-3;

// By this part σ is changed for derivatives.
constexpr double kDifference = 1e-2;
// Unknowns that are no displacements are extrapolated up to so many times σ: near the state they may
// be known to few digits.
constexpr double kFar = 4.0;

}  // namespace

StepContinuation::StepContinuation(Function equations, const Layout& layout)
    : equations_(std::move(equations)), layout_(layout) {
  ContainedUnknowns contained(equations_);
  contained_ = std::move(contained.places);
  solver_ = brief_linear_solver(contained.pattern);
  y_.resize(equations_.input_size(0));
  all_.resize(equations_.output_size() + equations_.nonzeros());
  step_.resize(static_cast<Index>(contained_.size()));
  rate_.resize(equations_.output_size());
  tangent_.resize(y_.size());
}

bool StepContinuation::shrinks(Index i) const {
  return i < layout_.displacements || i >= y_.size() - layout_.multipliers;
}

void StepContinuation::set(const VectorXd& u, double sigma, VectorXd& y) const {
  y = u;
  y.head(layout_.displacements) *= sigma;
  y.tail(layout_.multipliers) *= sigma;
}

void StepContinuation::evaluate(double sigma, bool with_jacobian) {
  part_of_h_ = sigma * h_;
  set(u_, sigma, y_);
  if (with_jacobian)
    equations_.value_and_jacobian(in_.data(), all_.data());
  else
    equations_.value(in_.data(), all_.data());
  if (given_.size() > 0) all_.head(given_.size()) -= part_ * given_;
}

// The largest of these changes of displacements, next to their sizes. `change`: for each contained
// unknown.
double StepContinuation::largest_part(const VectorXd& change, double sigma, double size) const {
  double largest = 0.0, total = 0.0;
  for (std::size_t k = 0; k < contained_.size(); ++k) {
    const double moved = std::fabs(change[static_cast<Index>(k)]);
    total += moved;
    if (contained_[k] < layout_.displacements)
      largest = std::max(largest, moved + sigma * std::fabs(u_[contained_[k]]));
  }
  const double least = std::max(kLeastOfAll * largest, kLeastOfState * size);
  double result = 0.0;
  for (std::size_t k = 0; k < contained_.size(); ++k) {
    const double moved = std::fabs(change[static_cast<Index>(k)]);
    if (contained_[k] >= layout_.displacements || !(moved > kRoundOff * size)) continue;
    const double before = sigma * u_[contained_[k]], after = before - change[static_cast<Index>(k)];
    const double own =
        std::max({std::fabs(before), std::fabs(after), sigma * usual_[contained_[k]]});
    result = std::max(result, moved / (own + least));
  }
  return std::isfinite(total) ? result : std::numeric_limits<double>::infinity();
}

bool StepContinuation::converges(double sigma, double size, double near, Result& result) {
  double previous = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    ++result.iterations;
    evaluate(sigma, true);
    if (!all_.allFinite() || !solver_->factorize(all_.data() + equations_.output_size()))
      return false;
    if (is_determined_ && !solver_->is_determined()) return false;
    solver_->solve(all_.data(), step_.data());
    const double change = largest_part(step_, sigma, size);
    if (!std::isfinite(change) || (iteration == 0 && change > near)) return false;
    if (iteration > 0 && change > kPathTolerance && change > kContraction * previous) return false;
    for (std::size_t k = 0; k < contained_.size(); ++k) {
      const Index i = contained_[k];
      const double moved = step_[static_cast<Index>(k)];
      u_[i] -= shrinks(i) ? moved / sigma : moved;
    }
    // The first change says nothing of the other unknowns, which may have been predicted badly. Without a
    // prediction it is no measure of the second one either: multipliers that forces of inertia belong to
    // wait for the velocity.
    if (iteration == 0 || change > kPathTolerance) {
      if (iteration > 0 || std::isfinite(near)) previous = change;
      continue;
    }
    const int orientation = solver_->orientation();
    if (orientation * orientation_ < 0) return false;
    if (orientation_ == 0) orientation_ = orientation;
    return u_.allFinite() && differentiate(sigma);
  }
  return false;
}

// Moves u_ by damped steps to where converges() may succeed.
bool StepContinuation::approach(double sigma, double size) {
  const auto move = [&](const VectorXd& to) {
    for (std::size_t k = 0; k < contained_.size(); ++k)
      u_[contained_[k]] = to[static_cast<Index>(k)];
  };
  const auto measured = std::count_if(contained_.begin(), contained_.end(),
                                      [&](Index i) { return i < layout_.displacements; });
  const DampedEquations equations{
      .linearize =
          [&](const VectorXd& at) {
            move(at);
            evaluate(sigma, true);
            return all_.allFinite() && solver_->factorize(all_.data() + equations_.output_size());
          },
      .correct =
          [&](const VectorXd& at, VectorXd& correction) {
            move(at);
            evaluate(sigma, false);
            solver_->solve(all_.data(), correction.data());
            for (std::size_t k = 0; k < contained_.size(); ++k)
              if (shrinks(contained_[k])) correction[static_cast<Index>(k)] /= sigma;
            return correction.allFinite();
          },
      .groups = {measured, std::ssize(contained_) - measured},
      .scales = Eigen::Vector2d(kLeastOfState * size / sigma, kUnmeasured * size)};
  VectorXd at(std::ssize(contained_));
  for (std::size_t k = 0; k < contained_.size(); ++k) at[static_cast<Index>(k)] = u_[contained_[k]];
  const bool arrived = damped_newton(equations, at);
  move(at);
  return arrived;
}

// du/dσ at u_, with the matrix of the last iteration.
bool StepContinuation::differentiate(double sigma) {
  const Index rows = equations_.output_size();
  evaluate(sigma * (1.0 + kDifference), false);
  rate_ = all_.head(rows);
  evaluate(sigma * (1.0 - kDifference), false);
  rate_ -= all_.head(rows);
  if (!rate_.allFinite()) return false;
  rate_ /= 2.0 * kDifference * sigma;
  solver_->solve(rate_.data(), step_.data());
  tangent_.setZero();
  for (std::size_t k = 0; k < contained_.size(); ++k) {
    const Index i = contained_[k];
    const double slope = -step_[static_cast<Index>(k)];
    tangent_[i] = shrinks(i) ? slope / sigma : slope;
  }
  return tangent_.allFinite();
}

// From the last point to u_, tangent_ at `next`, if both are on one arc.
bool StepContinuation::reaches(double next, double size, Result& result) {
  const double length = next - point_.sigma;
  const bool is_far = std::max(next, point_.sigma) > kFar * std::min(next, point_.sigma);
  u_ = point_.u;
  for (Index i = 0; i < u_.size(); ++i) {
    if (!vanishes_)
      u_[i] += (point_.sigma / next - 1.0) * u_[i] +
               length / next * (point_.u[i] + point_.sigma * point_.tangent[i]);
    else if (!is_far || shrinks(i))
      u_[i] += point_.tangent[i] * length;
  }
  predicted_ = u_;
  // Where unknowns are left open, as those of a gauge, the solutions of a step are a surface. What the
  // iteration takes of it need not be a curve with these tangents.
  bool is_reached = converges(next, size, kNear, result);
  if (!is_reached && !solver_->is_determined()) {
    u_ = point_.u;
    is_reached = converges(next, size, kNear, result);
  }
  if (!is_reached) return false;
  if (!solver_->is_determined()) return true;
  double sizes[3];  // of e, of what tangents say it is, and of the difference
  for (int what = 0; what < 3; ++what) {
    for (std::size_t k = 0; k < contained_.size(); ++k) {
      const Index i = contained_[k];
      const double left = next * (u_[i] - predicted_[i]);
      const double turned =
          vanishes_ ? next * (tangent_[i] - point_.tangent[i])
                    : u_[i] + next * tangent_[i] - point_.u[i] - point_.sigma * point_.tangent[i];
      const double bent = 0.5 * length * turned;
      step_[static_cast<Index>(k)] = what == 0 ? left : what == 1 ? bent : bent - left;
    }
    sizes[what] = largest_part(step_, next, size);
  }
  return sizes[2] <= std::max(kStraight, kOtherBend * std::max(sizes[0], sizes[1]));
}

StepContinuation::Result StepContinuation::follow(VectorXd& y, const Inputs& parameters,
                                                  double size, const VectorXd& usual) {
  usual_ = usual;
  parameters.require_count(equations_.input_count(), equations_.name());
  in_ = parameters;
  in_.set_unknowns(y_.data());
  h_ = *parameters[layout_.h];
  in_.set_parameter(layout_.h, &part_of_h_);
  const VectorXd start = y;
  const double fastest = layout_.displacements == 0
                             ? 0.0
                             : start.head(layout_.displacements).lpNorm<Eigen::Infinity>();
  const double seen = fastest > 0.0 ? kSeen * size / fastest : kFarthest;
  const double beginning = std::clamp(seen, kBeginning, kFarthest);
  u_ = start;
  evaluate(1.0, true);
  is_determined_ = all_.allFinite() && solver_->factorize(all_.data() + equations_.output_size()) &&
                   solver_->is_determined();
  Result result;
  std::optional<Result> ended;  // a curve from the state, so near it that round-off may be why
  for (const Attempt& attempt : {Attempt{true, true, beginning, kUnseen * seen},
                                 Attempt{false, true, beginning, kUnseen * seen},
                                 Attempt{false, false, kFarthest, kShortest},
                                 Attempt{false, false, kBeginning, kShortest}}) {
    if (!attempt.leads_back && is_determined_ && carries(start, size, result)) {
      y = u_;
      result.begins_at_state = true;
      break;
    }
    if (ended) {
      if (attempt.leads_back) continue;
      result = *ended;
      set(point_.u, point_.sigma, y);
      break;
    }
    if (!begins(attempt, start, size, result)) continue;
    // What begins where displacements are hardly seen may end in their round-off.
    const bool is_conclusive = attempt.leads_back && point_.sigma >= seen;
    track(size, result);
    result.begins_at_state = attempt.leads_back;
    set(point_.u, point_.sigma, y);
    if (result.arrived) break;
    if (!is_conclusive) continue;
    if (result.reached >= kFarthest) break;
    ended = result;
  }
  return result;
}

// Whether there is a first point, which is left in point_: a solution from which, if the attempt says
// so, the curve leads on towards the state as its tangent tells.
bool StepContinuation::begins(const Attempt& attempt, const VectorXd& start, double size,
                              Result& result) {
  constexpr double anywhere = std::numeric_limits<double>::infinity();
  vanishes_ = attempt.vanishes;
  for (double first = attempt.beginning; first > std::max(attempt.least, kShortest);
       first *= 0.125) {
    orientation_ = 0;
    u_ = start;
    if (!converges(first, size, anywhere, result)) {
      orientation_ = 0;
      u_ = start;
      if (!attempt.leads_back || !approach(first, size) ||
          !converges(first, size, anywhere, result))
        continue;
    }
    accept(first);
    if (!attempt.leads_back || reaches(0.25 * first, size, result)) return true;
  }
  return false;
}

// From the first point up to σ = 1, or as far as there are arcs.
void StepContinuation::track(double size, Result& result) {
  double length = 1.0;
  int arcs = 0;
  while (point_.sigma < 1.0) {
    const double sigma = point_.sigma;
    const double next = sigma + length >= 1.0 ? 1.0 : sigma + length;
    const long iterations = result.iterations;
    if (reaches(next, size, result)) {
      accept(next);
      ++arcs;
      length *= result.iterations - iterations <= 3 ? 3.0 : 1.5;
    } else {
      length = 0.3 * (next - sigma);
      if (length < kEnd * sigma) break;
    }
  }
  result.arrived = point_.sigma == 1.0;
  result.arcs = arcs;
  result.reached = point_.sigma;
}

// From the prediction to u_, the solution at σ = 1, by parts of what the equations leave there.
bool StepContinuation::carries(const VectorXd& start, double size, Result& result) {
  const Index rows = equations_.output_size();
  u_ = start;
  evaluate(1.0, true);
  if (!all_.allFinite() || !solver_->factorize(all_.data() + rows)) return false;
  orientation_ = solver_->orientation();
  vanishes_ = true;
  given_ = all_.head(rows);
  VectorXd from = start, direction(std::ssize(contained_));
  solver_->solve(given_.data(), direction.data());
  double tau = 0.0, length = 1.0;
  int arcs = 0;
  while (tau < 1.0 && length >= kEnd) {
    const double next = tau + length >= 1.0 ? 1.0 : tau + length;
    u_ = from;
    for (std::size_t k = 0; k < contained_.size(); ++k)
      u_[contained_[k]] -= (next - tau) * direction[static_cast<Index>(k)];
    part_ = 1.0 - next;
    if (direction.allFinite() && converges(1.0, size, kNear, result)) {
      tau = next;
      from = u_;
      ++arcs;
      length *= 2.0;
      solver_->solve(given_.data(), direction.data());
    } else {
      length *= 0.3;
    }
  }
  given_.resize(0);
  result.arrived = tau == 1.0;
  if (result.arrived) {
    result.arcs = arcs;
    result.reached = 1.0;
  }
  return result.arrived;
}

void StepContinuation::accept(double sigma) {
  point_.sigma = sigma;
  point_.u = u_;
  point_.tangent = tangent_;
}

}  // namespace courant
