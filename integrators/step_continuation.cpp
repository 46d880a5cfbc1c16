#include "courant/integrators/step_continuation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "courant/core/dense_solver.hpp"
#include "courant/core/unknown_selection.hpp"

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
constexpr double kTolerance = 1e-4;
constexpr double kRoundOff = 1e-13;

// A displacement is measured by its own size, but not by less than these parts of the largest one
// and of the coordinates.
constexpr double kLeastOfAll = 1e-3;
constexpr double kLeastOfState = 1e-8;

// The curve begins with two points at so much of the step and twice as much, which say where it goes;
// or at less, down to kShortest. First far from the state, since near to it multipliers that are
// determined with 1/h² are round-off; where that does not lead to the end, nearer.
constexpr double kBeginnings[] = {0.1, 1e-3};
constexpr double kShortest = 1e-12;
// The curve ends where σ can grow by less than this part.
constexpr double kEnd = 1e-4;

}  // namespace

StepContinuation::StepContinuation(Function equations, const Layout& layout)
    : equations_(std::move(equations)), layout_(layout) {
  ContainedUnknowns contained(equations_);
  contained_ = std::move(contained.places);
  solver_ = std::make_unique<DenseSolver>(contained.pattern);
  in_.resize(static_cast<std::size_t>(equations_.input_count()));
  y_.resize(equations_.input_size(0));
  all_.resize(equations_.output_size() + equations_.nonzeros());
  step_.resize(static_cast<Index>(contained_.size()));
}

void StepContinuation::set(const VectorXd& u, double sigma, VectorXd& y) const {
  y = u;
  y.head(layout_.displacements) *= sigma;
  y.tail(layout_.shifts) *= sigma;
}

// The largest change of a displacement, next to its size.
double StepContinuation::moved(double sigma, double size) const {
  double largest = 0.0, total = 0.0;
  for (std::size_t k = 0; k < contained_.size(); ++k) {
    const double change = std::fabs(step_[static_cast<Index>(k)]);
    total += change;
    if (contained_[k] < layout_.displacements)
      largest = std::max(largest, change + sigma * std::fabs(u_[contained_[k]]));
  }
  const double least = std::max(kLeastOfAll * largest, kLeastOfState * size);
  double result = 0.0;
  for (std::size_t k = 0; k < contained_.size(); ++k) {
    const double change = std::fabs(step_[static_cast<Index>(k)]);
    if (contained_[k] >= layout_.displacements || !(change > kRoundOff * size)) continue;
    const double before = sigma * u_[contained_[k]];
    const double after = before - step_[static_cast<Index>(k)];
    result = std::max(result, change / (std::max(std::fabs(before), std::fabs(after)) + least));
  }
  return std::isfinite(total) ? result : std::numeric_limits<double>::infinity();
}

bool StepContinuation::converges(double sigma, const double* const* in, double size, double near,
                                 Result& result) {
  const double h = sigma * h_;
  std::copy_n(in, in_.size(), in_.begin());
  in_[0] = y_.data();
  in_[static_cast<std::size_t>(layout_.h)] = &h;
  double previous = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    ++result.iterations;
    set(u_, sigma, y_);
    equations_.value_and_jacobian(in_.data(), all_.data());
    if (!all_.allFinite() || !solver_->factorize(all_.data() + equations_.output_size()))
      return false;
    solver_->solve(all_.data(), step_.data());
    const double change = moved(sigma, size);
    if (!std::isfinite(change) || (iteration == 0 && change > near)) return false;
    if (iteration > 0 && change > kTolerance && change > kContraction * previous) return false;
    for (std::size_t k = 0; k < contained_.size(); ++k) {
      const Index i = contained_[k];
      const bool shrinks = i < layout_.displacements || i >= u_.size() - layout_.shifts;
      u_[i] -= shrinks ? step_[static_cast<Index>(k)] / sigma : step_[static_cast<Index>(k)];
    }
    if (change > kTolerance) {
      previous = change;
      continue;
    }
    const int orientation = solver_->orientation();
    if (orientation * orientation_ < 0) return false;
    if (orientation_ == 0) orientation_ = orientation;
    return u_.allFinite();
  }
  return false;
}

StepContinuation::Result StepContinuation::follow(VectorXd& y, const double* const* in,
                                                  double size) {
  const VectorXd start = y;
  h_ = *in[layout_.h];
  Result farthest;
  long iterations = 0;
  for (const double beginning : kBeginnings) {
    Result found = follow_from(start, beginning, in, size);
    found.at_first = beginning == kBeginnings[0];
    iterations += found.iterations;
    if (found.reached >= farthest.reached) {
      farthest = found;
      set(point_, found.reached, y);
    }
    if (found.arrived) break;
  }
  farthest.iterations = iterations;
  return farthest;
}

StepContinuation::Result StepContinuation::follow_from(const VectorXd& start, double beginning,
                                                       const double* const* in, double size) {
  constexpr double anywhere = std::numeric_limits<double>::infinity();
  Result result;
  point_ = last_ = start;
  orientation_ = 0;
  double sigma = 0.0, before = 0.0;  // of point_ and last_
  for (double first = beginning; sigma == 0.0 && first > kShortest; first *= 0.125) {
    u_ = start;
    if (!converges(first, in, size, anywhere, result)) continue;
    last_ = u_;
    if (!converges(2.0 * first, in, size, anywhere, result)) continue;
    point_ = u_;
    before = first;
    sigma = 2.0 * first;
  }
  double length = 1.0;
  while (sigma > 0.0 && sigma < 1.0) {
    const double next = sigma + length >= 1.0 ? 1.0 : sigma + length;
    u_ = point_ + (point_ - last_) * ((next - sigma) / (sigma - before));
    const long iterations = result.iterations;
    if (converges(next, in, size, kNear, result)) {
      last_ = point_;
      before = sigma;
      point_ = u_;
      sigma = next;
      length *= result.iterations - iterations <= 3 ? 3.0 : 1.5;
    } else {
      length = 0.3 * (next - sigma);
      if (length < kEnd * sigma) break;
    }
  }
  result.arrived = sigma == 1.0;
  result.reached = sigma;
  return result;
}

}  // namespace courant
