#include "courant/core/limited_newton.hpp"

#include <algorithm>
#include <utility>

#include "courant/core/unknown_selection.hpp"

namespace courant {
namespace {

constexpr int kMostIterations = 300;
// Arguments that L was made at and leads to agree up to this: what is left of F is its square, and that is
// what the next step leaves the square of.
constexpr double kSettled = 1e-4;
// Where it begins exponentials are no farther up or down: a start may be anything.
constexpr double kFarthest = 40.0;

}  // namespace

LimitedNewton::LimitedNewton(Exponentials exponentials) : exponentials_(std::move(exponentials)) {
  const Function& L = exponentials_.linearized();
  ContainedUnknowns contained(L);
  contained_ = std::move(contained.places);
  solver_ = linear_solver(contained.pattern);
  in_.resize(static_cast<std::size_t>(L.input_count()));
  all_.resize(L.output_size() + L.nonzeros());
  step_.resize(std::ssize(contained_));
  held_.resize(exponentials_.count());
  arguments_.resize(exponentials_.count());
}

bool LimitedNewton::move(double* y, const double* const* in) {
  const Function& L = exponentials_.linearized();
  std::copy_n(in, in_.size() - 1, in_.begin());
  in_.back() = held_.data();
  L.value_and_jacobian(in_.data(), all_.data());
  if (!all_.allFinite() || !solver_->factorize(all_.data() + L.output_size())) return false;
  solver_->solve(all_.data(), step_.data());
  for (std::size_t k = 0; k < contained_.size(); ++k)
    y[contained_[k]] -= step_[static_cast<Index>(k)];
  return step_.allFinite();
}

bool LimitedNewton::solve(double* y, const double* const* in) {
  exponentials_.arguments().value(in, held_.data());
  held_ = held_.cwiseMin(kFarthest).cwiseMax(-kFarthest);
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    if (!held_.allFinite() || !move(y, in)) return false;
    exponentials_.arguments().value(in, arguments_.data());
    const bool is_settled = (arguments_ - held_).lpNorm<Eigen::Infinity>() <= kSettled;
    exponentials_.move(held_, arguments_);
    // Far down exponentials nothing may be left that determines y.
    if (is_settled) return move(y, in) && solver_->is_determined();
  }
  return false;
}

}  // namespace courant
