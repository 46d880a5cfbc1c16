#include "courant/integrators/methods/constrain_first_projection.hpp"

#include <algorithm>
#include <cmath>

#include "courant/core/linear/pairs.hpp"
#include "courant/core/linear/plain_products.hpp"

namespace courant {
namespace {

// P is found by solving with W of the last iterate until W no longer changes: contraction is about
// curvature × ‖μ‖ = O(h²).
constexpr int kMaxProjections = 30;

// What is left of x, relative to its size, when W is taken to change no more: less than round-off.
// The contraction that it is computed with is that of the last step, at most so many times too
// small.
constexpr double kTolerance = 1e-16;
constexpr double kSafety = 10.0;

// P takes the end of a step to the point of M_f nearby: to a distance below that part of the step.
// Solutions farther away are other ones, which an old factorisation can lead to.
constexpr double kNearby = 0.5;
// Of the coordinates, a part that is no distance.
constexpr double kNoDistance = 1e-10;

}  // namespace

ConstrainFirstProjection::ConstrainFirstProjection(const ConstrainFirstFunctions& functions,
                                                   TransportedFrame& basis)
    : functions_(functions),
      n_(functions.scheme.manifold().dimension()),
      d_(functions.scheme.codimension()),
      rest_((functions.blocks - 2) * n_ + functions.auxiliaries),
      solver_(functions.projection, {n_, n_, rest_, d_}, functions.scheme.name() + " (projection)"),
      is_explicit_(solver_.is_explicit() && functions.projection.left().output_size() == 0 &&
                   functions_.scheme.has_fixed_directions() &&
                   n_ == functions.scheme.manifold().tangent_dimension()),
      gives_all_(is_explicit_ && std::ssize(solver_.found()) == solver_.unknown().size()),
      end_(predicted_groups(functions, solver_.unknown().size()),
           functions.scheme.fixed_directions.size() > 0 ? solver_.predicted() : solver_.found()),
      shift_({functions.scheme.manifold().tangent_dimension()}),
      basis_(basis),
      conormals_(functions.conormals, n_, d_, functions.references),
      directions_(*functions.scheme.projector, functions.span, n_, d_),
      jets_(VectorXd::Zero(solver_.unknown().size())),
      given_(jets_),
      start_(jets_),
      near_(functions.scheme.manifold().ambient_dimension()),
      guess_(near_.size()),
      shifted_(VectorXd::Zero(functions.scheme.manifold().tangent_dimension())),
      corrected_(shifted_),
      vectors_(shifted_.size(), functions.blocks),
      found_(functions.projected.output_size()),
      velocity_(n_) {}

std::vector<Index> ConstrainFirstProjection::predicted_groups(
    const ConstrainFirstFunctions& functions, Index unknowns) {
  const Index tangent = functions.blocks * functions.scheme.manifold().dimension();
  return {tangent, unknowns - tangent};
}

std::array<double, 4> ConstrainFirstProjection::scales(const State& before, double h,
                                                       double besides) {
  const double size = coordinate_scale(before, h, besides);
  return {size, size / std::fabs(h), auxiliary_scale(largest(before.z), size), size};
}

// ξ and μ
void ConstrainFirstProjection::clear_places(VectorXd& y) const {
  y.head(n_).setZero();
  y.tail(d_).setZero();
}

const VectorXd& ConstrainFirstProjection::jets() {
  clear_places(jets_);
  return jets_;
}

void ConstrainFirstProjection::begin_with(const VectorXd& y) {
  if (!gives_all_) copy_pairs(y.data(), y.size(), solver_.unknown().data());
}

void ConstrainFirstProjection::project(const VectorXd& near, const Approach& approach,
                                       SolverStatistics& statistics) {
  const State& before = approach.before;
  const StepSolver::Attempt& attempt = approach.attempt;
  const double t = time_ = approach.t;
  const bool goes_on = approach.goes_on;
  VectorXd& y = gives_all_ ? given_ : solver_.unknown();
  if (!gives_all_) clear_places(y);
  if (is_explicit_) {
    const double* const in[] = {
        y.data(), near.data(), basis_.data(), directions_.matrix().data(), near.data(), &t};
    functions_.projection.unknowns().value(in, y.data());
    functions_.projected.value(in, found_.data());
    if (functions_.redundant.output_size() > 0) guess_ = near_ = near;
    return;
  }
  near_ = near;
  guess_ = near_;
  const double speed = goes_on ? largest_speed(before, y) : 0.0;
  if (goes_on && !shift_.is_empty()) {
    shift_.predict(shifted_);
    const double* in[] = {near_.data(), shifted_.data()};
    functions_.shift.value(in, guess_.data());
  }
  foreseen_ = guess_;
  double previous = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < kMaxProjections; ++iteration) {
    move_basis(guess_, y);
    start_ = y;
    if (iteration == 0 && goes_on && !end_.is_empty()) {
      end_.predict(y);
      y.head(n_).setZero();
      solver_.settle(start_);
    }
    aim(guess_, y, t);
    aimed_ = y;
    const Inputs in(y.data(),
                    {guess_.data(), basis_.data(), directions_.matrix().data(), near_.data(), &t});
    const auto sizes = scales(before, attempt.h, largest(near_));
    const auto begin = [&] { y = start_; };
    const auto lands_nearby = [&] {
      solver_.solve(in, sizes.data(), begin, attempt, statistics);
      functions_.projected.value(in.data(), found_.data());
      return !goes_on || is_nearby(before, attempt.h * speed, sizes[0]);
    };
    if (!lands_nearby()) {
      ++statistics.failures;
      solver_.forget();
      begin();
      if (!lands_nearby())
        throw SolveError(SolveError::Reason::disconnected, functions_.scheme.name(), attempt.time,
                         attempt.h,
                         "is too large: the projection onto M_f leads farther than half the "
                         "step.");
    }
    const double moved = largest(y.head(n_));
    const double size = largest(found_.head(guess_.size()));
    if (functions_.scheme.has_fixed_directions()) return;
    // P does not depend on W once x no longer moves with it. Where steps begin, x moves with W not
    // at all; but the next one begins along W.
    if (iteration == 0) {
      const double distance = std::sqrt(
          std::max(plain_product(y.data() + (y.size() - d_), y.data() + (y.size() - d_), d_),
                   plain_product(approach.from_M_f.data(), approach.from_M_f.data(), d_)));
      const double change = std::max(moved, size * jet_change(aimed_, y));
      if (goes_on && kSafety * turning_ * distance * change <= kTolerance * size) return;
    } else {
      const double contraction = moved / previous;
      if (moved <= 1e-15 * size || contraction * moved <= kTolerance * size ||
          (contraction >= 0.5 && moved < 1e-10 * (1.0 + size)))
        return;
    }
    guess_ = found_.head(guess_.size());
    y.head(n_).setZero();
    previous = moved;
  }
  throw SolveError(SolveError::Reason::diverged, functions_.scheme.name(), attempt.time, attempt.h,
                   "is too large: the projection onto M_f does not converge.");
}

// The largest of the velocity before the step, of that in its middle and of that after it, extrapolated.
double ConstrainFirstProjection::largest_speed(const State& before, const VectorXd& y) {
  if (n_ == 0) return 0.0;
  basis_.coordinates_of(before.v, velocity_);
  const auto middle = y.segment(n_, n_);
  return std::max({velocity_.lpNorm<Eigen::Infinity>(), middle.lpNorm<Eigen::Infinity>(),
                   (2.0 * middle - velocity_).lpNorm<Eigen::Infinity>()});
}

// Whether what was found is not far from near_, next to the step from `before` and to coordinates of
// that size; nor ξ from guess_, which may have gone around a compact space. Where a coordinate turns it is
// back after the step where it was: how far the step led, its velocities tell.
bool ConstrainFirstProjection::is_nearby(const State& before, double path, double size) const {
  const auto found = found_.head(near_.size());
  const double step = std::max((near_ - before.x).lpNorm<Eigen::Infinity>(), std::fabs(path));
  const double nearby = std::max(kNearby * step, kNoDistance * size);
  const double foreseen = (guess_ - near_).lpNorm<Eigen::Infinity>();
  return (found - near_).lpNorm<Eigen::Infinity>() <= nearby &&
         largest(solver_.unknown().head(n_)) <= nearby + 2.0 * foreseen;
}

// By how much ξ', … and z, … differ, relative to their size: W is computed with them.
double ConstrainFirstProjection::jet_change(const VectorXd& from, const VectorXd& to) const {
  const auto change = [&](Index first, Index size) {
    const double moved = (to - from).segment(first, size).lpNorm<Eigen::Infinity>();
    return moved == 0.0 ? 0.0 : moved / to.segment(first, size).lpNorm<Eigen::Infinity>();
  };
  return std::max(change(n_, n_), rest_ == 0 ? 0.0 : change(2 * n_, rest_));
}

// The same vectors in the basis at x.
void ConstrainFirstProjection::move_basis(const VectorXd& x, VectorXd& y) {
  if (n_ == functions_.scheme.manifold().tangent_dimension()) return;
  const MatrixXd& B = basis_.map().entries();
  const Index size = B.rows();
  plain_product(B.data(), size, y.data(), n_, functions_.blocks, vectors_.data());
  if (!basis_.move_to(x)) is_turned_ = true;
  for (Index k = 0; k < functions_.blocks; ++k)
    for (Index j = 0; j < n_; ++j)
      y[k * n_ + j] = plain_product(B.data() + j * size, vectors_.data() + k * size, size);
}

// W at x, with columns near those of the last step, so that μ and the kept factorisations go on.
void ConstrainFirstProjection::aim(const VectorXd& x, const VectorXd& y, double t) {
  if (functions_.scheme.has_fixed_directions()) return;
  conormals_.move_to({.jets = y.data(), .origin = x.data(), .basis = basis_.data(), .t = &t});
  directions_.move_to(x, t, basis_.map(), conormals_.matrix());
}

void ConstrainFirstProjection::record() {
  if (is_explicit_) return;
  VectorXd& y = solver_.unknown();
  if (!solver_.is_determined()) end_.limit_degree(Predictor::kUndetermined);
  y.head(n_).setZero();
  end_.record(y);
  // shifted_ led to foreseen_: to first order in what is left, this one leads to x.
  const double* in[] = {near_.data(), shifted_.data(), foreseen_.data(), found_.data()};
  functions_.corrected_shift.value(in, corrected_.data());
  shift_.record(corrected_);
}

// Newton's method asks for eight digits of what converges with the state, and for all of the state and its velocity.
bool ConstrainFirstProjection::redundant_hold(const State& before, double h) {
  constexpr double of_states = 1e-14, of_others = 1e-7;
  constexpr double at_rest =
      1e-3;  // of what moves coordinates by their size in a step, no velocity
  const Function& F = functions_.redundant;
  const VectorXd& y = gives_all_ ? given_ : solver_.unknown();
  const double* const in[] = {
      y.data(), guess_.data(), basis_.data(), directions_.matrix().data(), near_.data(), &time_};
  redundant_.resize(F.output_size() + F.nonzeros());
  F.value_and_jacobian(in, redundant_.data());
  const auto sizes = scales(before, h, largest(near_));
  VectorXd terms = VectorXd::Zero(F.output_size());
  VectorXd part = VectorXd::Constant(F.output_size(), of_states);
  for (std::size_t k = 0; k < F.pattern_row().size(); ++k) {
    const Index i = F.pattern_row()[k], j = F.pattern_col()[k];
    const double size = j < n_       ? sizes[0]
                        : j < 2 * n_ ? std::max(std::fabs(y[j]), at_rest * sizes[1])
                                     : std::fabs(y[j]);
    terms[i] += std::fabs(redundant_[F.output_size() + static_cast<Index>(k)]) * size;
    if (j >= 2 * n_) part[i] = of_others;
  }
  for (Index i = 0; i < F.output_size(); ++i)
    if (!(std::fabs(redundant_[i]) <= part[i] * terms[i])) return false;
  return true;
}

void ConstrainFirstProjection::take(State& state) const {
  const Index N = near_.size();
  state.x.resize(N);
  const double* from = found_.data();
  for (VectorXd* part : {&state.x, &state.v, &state.z}) {
    copy_pairs(from, part->size(), part->data());
    from += part->size();
  }
}

bool ConstrainFirstProjection::accept(const VectorXd& x) {
  if (!functions_.scheme.has_fixed_directions()) {
    const double moved = plain_distance(found_.data(), x.data(), x.size());
    if (directions_.is_kept() && moved > 1e-7 * largest(x)) {
      const MatrixXd& W = directions_.matrix();
      const double turning = plain_distance(W.data(), directions_.kept().data(), W.size()) / moved;
      turning_ = std::isfinite(turning_) ? std::max(turning, 0.9 * turning_) : turning;
    }
    directions_.keep();
    conormals_.keep();
  }
  copy_pairs(found_.data(), guess_.size(), guess_.data());
  if (!basis_.move_to(guess_)) is_turned_ = true;
  basis_.keep();
  const bool goes_on = !is_turned_;
  if (is_turned_) forget_motion();
  is_turned_ = false;
  if (gives_all_)
    jets_.swap(given_);
  else
    copy_pairs(solver_.unknown().data(), jets_.size(), jets_.data());
  return goes_on;
}

void ConstrainFirstProjection::take_over(const ConstrainFirstProjection& other, bool goes_on) {
  if (!goes_on) forget_motion();
  conormals_.take_over(other.conormals_);
  directions_.take_over(other.directions_);
  jets_ = other.jets_;
  turning_ = other.turning_;
  is_turned_ = false;
}

void ConstrainFirstProjection::learn_from(const ConstrainFirstProjection& other,
                                          const Stepper::Companion& companion) {
  const double ratio = companion.ratio, times = companion.at_end;
  if (times == 0.0 || is_explicit_) return;
  end_.learn_from(other.end_, times_of(times, ratio, 0));
  shift_.learn_from(other.shift_, VectorXd::Constant(shifted_.size(), times * (ratio * ratio)));
}

// Steps end off M_f by what goes like their squares.
VectorXd ConstrainFirstProjection::times_of(double times, double ratio, Index displacements) const {
  VectorXd all = VectorXd::Constant(solver_.unknown().size(), times);
  all.head(displacements) *= ratio;
  all.tail(d_) *= ratio * ratio;
  return all;
}

void ConstrainFirstProjection::discard() {
  conormals_.discard();
  directions_.discard();
  is_turned_ = false;
}

void ConstrainFirstProjection::forget_motion() {
  end_.forget();
  shift_.forget();
}

void ConstrainFirstProjection::forget() {
  solver_.forget();
  forget_motion();
  conormals_.forget();
  directions_.forget();
  is_turned_ = false;
  turning_ = std::numeric_limits<double>::infinity();
  jets_.setZero();
  shifted_.setZero();
}

}  // namespace courant
