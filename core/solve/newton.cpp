#include "courant/core/solve/newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "courant/core/linear/solver_choice.hpp"
#include "courant/core/solve/broyden_update.hpp"
#include "courant/core/solve/damped_newton.hpp"
#include "courant/core/solve/unknown_change.hpp"
#include "courant/core/solve/unknown_selection.hpp"

namespace courant {
namespace {

// Iterates that stop contracting while they move less than this, relative to the scale, move by
// round-off. Larger than n·eps·condition for every matrix that the solver lets through in practice,
// far below any tolerance a user would set.
constexpr double kRoundOff = 1e-9;

// With a matrix that was made after such a short change steps contract by about its length, unless the
// root is of high multiplicity. Those that keep nine tenths of their length are round-off, enlarged by
// a matrix that is nearly singular. A matrix that was made farther away may contract slowly, to half
// and more where a step is long: its steps are no round-off because they stay as short as that.
constexpr double kShort = 1e-4;
constexpr double kStagnant = 0.9;

// Round-off is measured with a new factorisation, and again when this has made it too small.
constexpr double kForget = 0.998;

// Residuals below these parts of their terms are rounding errors.
constexpr double kRounded = 16.0 * std::numeric_limits<double>::epsilon();
// Above these, after iterations that do not move any more, something is not solved.
constexpr double kSolved = 1e-9;

// Next to their terms, where the equations have exponentials that are not settled.
constexpr double kHolds = 2e-14;

// Relative changes that are round-off everywhere.
constexpr double kLeast = 2.0 * std::numeric_limits<double>::epsilon();

// As PairMaximum and PairSum, of single numbers.
struct NumberMaximum {
  void add(double number) { value_ = std::max(value_, number); }
  double value() const { return value_; }
  double value_ = 0.0;
};
struct NumberSum {
  void add(double number) { value_ += number; }
  double value() const { return value_; }
  double value_ = 0.0;
};

// u_i ← u_i - change_i for begin ≤ i < end.
auto subtract(double* u, const double* change, Index begin, Index end) {
  PairChange movement;
  for_each_pair(begin, end, [&]<class Numbers>(Index i, Numbers) {
    movement.move(u + i, read<Numbers>(change + i));
  });
  return movement;
}

// The same for the unknowns at these places.
auto subtract(double* u, const double* change, const Index* places, Index begin, Index end) {
  UnknownChange<NumberMaximum, NumberSum> movement;
  for (Index i = begin; i < end; ++i) movement.move(u + places[i], change[i]);
  return movement;
}

}  // namespace

Newton::Newton(EquationSystem system, std::vector<Index> groups, const Options& options)
    : system_(std::move(system)), function_(system_.left()), options_(options) {
  if (groups.empty()) groups.push_back(system_.size());
  if (std::accumulate(groups.begin(), groups.end(), Index{0}) != system_.size())
    throw std::invalid_argument("Newton: the groups do not fit the " +
                                std::to_string(system_.size()) + " unknowns of " + system_.name() +
                                ".");
  Index before = 0;
  for (const Index end : group_ends(groups, system_.kept())) {
    groups_.push_back(end - before);
    before = end;
  }
  find_contained();
  ends_ = group_ends(groups_, contained_);
  is_contiguous_ =
      !contained_.empty() && contained_.back() - contained_.front() + 1 == std::ssize(contained_);
  sizes_.setZero(std::ssize(ends_));
  moved_.setZero(std::ssize(ends_));
  while (group_ + 1 < ends_.size() && ends_[group_] == 0) ++group_;
  is_explicit_ = contained_.empty() && function_.output_size() == 0;
  is_one_group_ = ends_[group_] == ends_.back();
  if (is_contiguous_ && is_one_group_) contraction_ = Contraction(std::ssize(contained_));
  std::vector<bool> is_contained(system_.kept().size());
  for (const Index place : contained_) is_contained[static_cast<std::size_t>(place)] = true;
  for (std::size_t k = 0; k < is_contained.size(); ++k)
    (is_contained[k] ? sought_ : left_).push_back(system_.kept()[k]);
  if (system_.is_reduced()) kept_.resize(std::ssize(system_.kept()));
  if (system_.by_engine()) return;
  all_.resize(function_.output_size() + function_.nonzeros());
  step_.resize(static_cast<Index>(contained_.size()));
  settled_.resize(step_.size());
  before_.resize(step_.size());
  weighted_.resize(step_.size());
  magnitude_.resize(function_.output_size());
  stalled_.resize(function_.output_size());
  if (system_.exponentials().count() > 0) {
    exponentials_.emplace(system_.exponentials());
    limited_.emplace(system_.exponentials());
  }
  if (function_.output_size() == step_.size()) matrix_numbers_ = function_.matrix_numbers();
  held_.resize(function_.held_size());
}

// Which unknowns the equations contain; makes the solver for a matrix of these.
void Newton::find_contained() {
  if (const auto& by_engine = system_.by_engine()) {
    contained_ = by_engine->contained();
    return;
  }
  ContainedUnknowns contained(function_);
  contained_ = std::move(contained.places);
  solver_ = options_.solver ? options_.solver(contained.pattern) : linear_solver(contained.pattern);
}

bool Newton::factorize(const Inputs& in) {
  matrix_numbers_.keep(in);
  function_.value_and_jacobian_with_held(in.data(), all_.data());
  if (exponentials_) exponentials_->keep(in);
  factorized_ = solver_->factorize(all_.data() + function_.output_size());
  inverse_ = factorized_ ? solver_->inverse() : nullptr;
  return factorized_;
}

Contraction::Workspace Newton::workspace(double* y) {
  return {.inverse = inverse_,
          .u = y + contained_.front(),
          .residual = all_.data(),
          .change = step_.data(),
          .before = before_.data()};
}

// y ← y - A F. Returns the largest change of a block relative to its scale.
double Newton::improve(double* y, const double* scales) {
  if (contraction_.is_available() && inverse_ != nullptr) {
    double& size = sizes_[static_cast<Index>(group_)];
    const double change = contraction_.improve(workspace(y), size);
    size = std::max(scales[group_], size);
    return contraction::relative(change, size);
  }
  solver_->solve(all_.data(), step_.data());
  double result = 0.0;
  bool is_finite = true;
  slowest_ = 0.0;
  Index begin = 0;
  for (std::size_t g = 0; g < ends_.size(); begin = ends_[g++]) {
    const auto take = [&](const auto& movement) {
      is_finite &= movement.is_finite();
      const double size = std::max(scales[g], movement.sizes.value());
      sizes_[static_cast<Index>(g)] = size;
      double& moved = moved_[static_cast<Index>(g)];
      const double before = moved;
      moved = contraction::relative(movement.changes.value(), size);
      if (moved > kLeast && !is_one_group_) slowest_ = std::max(slowest_, moved / before);
      result = std::max(result, moved);
    };
    if (is_contiguous_)
      take(subtract(y + contained_.front(), step_.data(), begin, ends_[g]));
    else
      take(subtract(y, step_.data(), contained_.data(), begin, ends_[g]));
  }
  return is_finite ? result : std::numeric_limits<double>::infinity();
}

// The kept inverse, by the last two changes, both made with it.
void Newton::learn() {
  Index begin = 0;
  for (std::size_t g = 0; g < ends_.size(); begin = ends_[g++]) {
    const double size = sizes_[static_cast<Index>(g)];
    if (!(size > 0.0)) {
      weighted_.segment(begin, ends_[g] - begin).setZero();
      continue;
    }
    const double unit = 1.0 / size;
    for_each_pair(begin, ends_[g], [&]<class Numbers>(Index i, Numbers) {
      write(weighted_.data() + i, Numbers(read<Numbers>(before_.data() + i) * unit * unit));
    });
  }
  broyden_update(inverse_, before_.data(), step_.data(), weighted_.data(), step_.size());
}

// Σ_j |J_ij| size(j) for each equation i, by the Jacobian that was evaluated last.
template <class Size>
void Newton::sum_terms(const Size& size) {
  magnitude_.setZero();
  const Index rows = magnitude_.size();
  const auto& row = function_.pattern_row();
  const auto& column = function_.pattern_col();
  for (std::size_t k = 0; k < row.size(); ++k)
    magnitude_[row[k]] += std::fabs(all_[rows + static_cast<Index>(k)]) * size(column[k]);
}

// The largest part that a residual is of the terms J_ij y_j of its equation, or with `any` of the terms of any
// equation. An unknown that is an increment belongs to a sum of the size of its block's scale.
double Newton::unsolved_part(const double* y, const double* scales, bool any) {
  sum_terms([&](Index j) {
    std::size_t g = 0;
    for (Index end = groups_[0]; j >= end; end += groups_[++g]) {
    }
    return std::max(std::fabs(y[j]), std::min(scales[g], scales[0]));
  });
  if (any && magnitude_.size() > 0) magnitude_.setConstant(magnitude_.maxCoeff());
  return largest_part(magnitude_);
}

double Newton::largest_part(const VectorXd& magnitude) const {
  double result = 0.0;
  for (Index i = 0; i < magnitude.size(); ++i) {
    const double left = std::fabs(all_[i]);
    if (!(left <= result * magnitude[i])) result = left / magnitude[i];  // or not a number
    if (std::isnan(result)) break;
  }
  return result;
}

bool Newton::sees_all() const {
  return solver_->is_determined() && function_.output_size() == step_.size();
}

// Whether small changes mean small residuals. A matrix that is not square, or singular, sees some
// directions only; one that is old may have lost others. With a matrix of this solve least squares are at
// their least; what is left of equations that repeat others where their own terms vanish is round-off
// of theirs.
bool Newton::is_solved(const double* y, const double* scales, bool fresh) {
  return sees_all() || unsolved_part(y, scales, fresh) <= kSolved;
}

// Whether changes that do not become smaller, though they are small, are round-off. Where a scale is far
// above what an exponential is steep over, as for voltages of diodes, Newton's steps down its flank are as
// small, and as equal; but there residuals fall from one matrix to the next. `before`: what was left with the
// matrix before, in parts of the terms where changes stalled first, or -1; and then with this one.
bool Newton::is_still(const double* y, const double* scales, bool fresh, double& before) {
  if (!sees_all()) return is_solved(y, scales, fresh);
  const double part = unsolved_part(y, scales, false);
  if (part <= kSolved) return true;
  const bool is_first = before < 0.0;
  if (is_first) stalled_ = magnitude_;
  const double left = is_first ? part : largest_part(stalled_);
  const bool falls = is_first || left < 0.5 * before;
  before = left;
  return !falls;
}

// Whether what exponentials are of does not change any more, or else the equations hold next to their terms at y, by the
// matrix there. Scales say nothing of this: voltages of diodes are measured by 10⁷ times their size, next to which all of
// an exponential is round-off.
bool Newton::is_settled(const Inputs& in, bool fresh) {
  if (!exponentials_ || exponentials_->is_settled(in, contained_, step_)) return true;
  if (!fresh) return false;
  function_.value_and_jacobian_with_held(in.data(), all_.data());
  sum_terms([y = in[0]](Index j) { return std::fabs(y[j]); });
  return largest_part(magnitude_) <= kHolds;
}

void Newton::settle(VectorXd& y, const VectorXd& y0) {
  if (!factorized_ || is_determined()) return;
  const auto place = [&](std::size_t k) {
    return system_.kept()[static_cast<std::size_t>(contained_[k])];
  };
  for (std::size_t k = 0; k < contained_.size(); ++k) {
    settled_[static_cast<Index>(k)] = y[place(k)];
    step_[static_cast<Index>(k)] = y0[place(k)];
  }
  solver_->settle(settled_.data(), step_.data());
  for (std::size_t k = 0; k < contained_.size(); ++k) y[place(k)] = settled_[static_cast<Index>(k)];
}

// What the equations that are left take: u in place of y, and what they hold.
const Inputs& Newton::take_kept(const Inputs& in) {
  if (!system_.by_engine()) in.require_count(function_.input_count(), system_.name());
  if (!system_.is_reduced() && held_.size() == 0) return in;
  in_ = in;
  if (system_.is_reduced()) {
    in_.set_unknowns(kept_.data());
    for (Index i = 0; i < kept_.size(); ++i)
      kept_[i] = in[0][system_.kept()[static_cast<std::size_t>(i)]];
  }
  if (held_.size() > 0) {
    function_.hold(in_.data(), held_.data());
    in_.add_parameter(held_.data());
  }
  return in_;
}

// All unknowns by those that are kept.
void Newton::give(double* y) { system_.unknowns().value(in_.data(), y); }

const Newton::Result& Newton::solve(const Inputs& in, const double* scales) {
  const Inputs& of_kept = take_kept(in);
  result_.status = is_explicit_          ? Status::converged
                   : system_.by_engine() ? solve_by_engine(of_kept, scales, false)
                                         : solve_kept(of_kept, scales);
  if (system_.is_reduced()) give(in.unknowns());
  return result_;
}

bool Newton::approach(const Inputs& in, const double* scales) {
  const Inputs& of_kept = take_kept(in);
  const bool is_reduced = system_.is_reduced();
  if (system_.by_engine()) {
    const bool arrived = solve_by_engine(of_kept, scales, true) == Status::converged;
    if (arrived && is_reduced) give(in.unknowns());
    return arrived;
  }
  double* const u = of_kept.unknowns();
  if (limited_) {
    const VectorXd from = Eigen::Map<const VectorXd>(u, function_.input_size(0));
    Inputs without_held = of_kept;
    if (held_.size() > 0) without_held.drop_parameter();
    if (limited_->solve(without_held)) {
      reset();
      if (is_reduced) give(in.unknowns());
      return true;
    }
    std::copy(from.begin(), from.end(), u);
  }
  DampedEquations equations;
  Index begin = 0;
  for (const Index end : ends_) {
    equations.groups.push_back(end - begin);
    begin = end;
  }
  equations.scales = Eigen::Map<const VectorXd>(scales, std::ssize(ends_));
  const auto move = [&](const VectorXd& to) {
    for (std::size_t k = 0; k < contained_.size(); ++k)
      u[contained_[k]] = to[static_cast<Index>(k)];
  };
  equations.linearize = [&](const VectorXd& at) {
    move(at);
    return factorize(of_kept);
  };
  equations.correct = [&](const VectorXd& at, VectorXd& correction) {
    move(at);
    function_.value_with_held(of_kept.data(), all_.data());
    solver_->solve(all_.data(), correction.data());
    return correction.allFinite();
  };
  VectorXd at(std::ssize(contained_));
  for (std::size_t k = 0; k < contained_.size(); ++k) at[static_cast<Index>(k)] = u[contained_[k]];
  const VectorXd start = at;
  const bool arrived = damped_newton(equations, at);
  move(arrived ? at : start);
  reset();
  if (arrived && is_reduced) give(in.unknowns());
  return arrived;
}

Newton::Status Newton::solve_by_engine(const Inputs& in, const double* scales, bool is_damped) {
  const EngineEquations::Answer answer = system_.by_engine()->solve({.in = in,
                                                                     .ends = ends_,
                                                                     .scales = scales,
                                                                     .asker = this,
                                                                     .keeps_matrix = factorized_,
                                                                     .is_damped = is_damped});
  result_.iterations = answer.iterations;
  result_.factorizations = answer.factorizations;
  result_.residuals.clear();
  factorized_ = answer.has_converged;
  if (answer.has_converged) return Status::converged;
  result_.residuals.push_back(answer.residual);
  return answer.is_finite ? Status::diverged : Status::singular;
}

Newton::Status Newton::solve_kept(const Inputs& in, const double* scales) {
  Result& result = result_;
  result.iterations = result.factorizations = 0;
  result.residuals.clear();
  double* const y = in.unknowns();
  const auto residual = all_.head(function_.output_size());
  double previous = std::numeric_limits<double>::infinity();
  bool fresh = false;      // A belongs to a point of this solve
  bool close = false;      // which a short change led to
  double unsolved = -1.0;  // where changes stalled before, if they did
  bool evaluated = false;  // F is that of y
  bool learned = false;    // A has learned from this solve
  int compared = 0;        // iterations with the same A before, which made `previous`
  double moved = std::numeric_limits<double>::infinity();
  const auto refactorize = [&] {
    ++result.factorizations;
    fresh = true;
    close = moved <= kShort;
    compared = 0;
    evaluated = true;
    return factorize(in);
  };
  if (!factorized_ && !refactorize()) return Status::singular;
  const bool is_exact = matrix_numbers_.are_kept(in);
  // Most solves are over before anything else has to be looked at.
  bool has_moved = false;
  if (contraction_.is_available() && inverse_ != nullptr && !fresh && !exponentials_) {
    const Contraction::Result quick = contraction_(function_, in, workspace(y),
                                                   {.scale = scales[group_],
                                                    .tolerance = options_.tolerance,
                                                    .slow = options_.slow,
                                                    .most = options_.max_iterations,
                                                    .is_exact = is_exact});
    result.iterations = quick.iterations;
    if (quick.has_converged) return Status::converged;
    sizes_[static_cast<Index>(group_)] = quick.size;
    moved = quick.moved;
    previous = quick.previous;
    compared = quick.iterations - 1;
    learned = quick.has_learned;
    has_moved = true;
  }
  while (has_moved || result.iterations < options_.max_iterations) {
    if (!has_moved) {
      ++result.iterations;
      if (!evaluated) function_.value_with_held(in.data(), all_.data());
      moved = improve(y, scales);
    }
    evaluated = has_moved = false;
    if (!std::isfinite(moved)) {
      result.residuals.push_back(residual.size() == 0 ? 0.0 : residual.lpNorm<Eigen::Infinity>());
      return Status::diverged;
    }
    // Least squares of a matrix of this solve are at their least, but that may be no solution.
    const auto accepted = [&] { return is_solved(y, scales, fresh); };
    if (moved <= options_.tolerance) {
      if (!accepted()) {
        if (fresh) break;
        if (refactorize()) continue;
        return Status::singular;
      }
      if (!is_settled(in, fresh)) {
        if (refactorize()) continue;
        return Status::singular;
      }
      return Status::converged;
    }
    if (is_exact && compared == 0 && moved <= contraction::kForeseen && accepted())
      return Status::converged;
    if (compared > 0) {
      const double part = moved / previous;
      if (contraction::has_ended(moved, previous, options_.tolerance) &&
          contraction::has_ended_everywhere(moved, slowest_, options_.tolerance) && accepted() &&
          is_settled(in, fresh)) {
        return Status::converged;
      }
      // With an old factorisation, changes that do not become smaller may come from its age.
      const bool stalled = part > 0.5;
      const bool stagnant = fresh && compared == 1 && part > kStagnant && moved <= kShort;
      const bool rounded =
          stalled && (moved > kRoundOff ? stagnant || unsolved_part(y, scales, false) <= kRounded
                                        : close || moved <= std::max(kLeast, 2 * round_off_));
      const bool slow = part > options_.slow && moved > 1e3 * options_.tolerance;
      if ((slow && !fresh) || (stalled && !rounded) ||
          (rounded && (!is_still(y, scales, fresh, unsolved) || !is_settled(in, fresh)))) {
        if (!refactorize()) {
          return Status::singular;
        }
        continue;
      }
      if (rounded) {
        round_off_ = close && moved <= kRoundOff ? moved : kForget * round_off_;
        return Status::converged;
      }
    }
    if (inverse_ != nullptr && !learned && !exponentials_) {
      learned = compared > 0 && contraction::teaches(moved, previous);
      if (learned)
        learn();
      else
        before_.swap(step_);
    }
    previous = moved;
    ++compared;
  }
  result.residuals.push_back(residual.size() == 0 ? 0.0 : residual.lpNorm<Eigen::Infinity>());
  return Status::diverged;
}

}  // namespace courant
