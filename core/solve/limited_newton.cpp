#include "courant/core/solve/limited_newton.hpp"

#include <algorithm>
#include <utility>

#include "courant/core/linear/solver_choice.hpp"
#include "courant/core/solve/unknown_selection.hpp"

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
  all_.resize(L.output_size() + L.nonzeros());
  step_.resize(std::ssize(contained_));
  held_.resize(exponentials_.count());
  arguments_.resize(exponentials_.count());
}

bool LimitedNewton::move(const Inputs& in) {
  const Function& L = exponentials_.linearized();
  Inputs with_held = in;
  with_held.add_parameter(held_.data());
  L.value_and_jacobian(with_held.data(), all_.data());
  if (!all_.allFinite() || !solver_->factorize(all_.data() + L.output_size())) return false;
  solver_->solve(all_.data(), step_.data());
  for (std::size_t k = 0; k < contained_.size(); ++k)
    in.unknowns()[contained_[k]] -= step_[static_cast<Index>(k)];
  return step_.allFinite();
}

bool LimitedNewton::solve(const Inputs& in) {
  const Function& arguments = exponentials_.arguments();
  in.require_count(arguments.input_count(), arguments.name());
  arguments.value(in.data(), held_.data());
  held_ = held_.cwiseMin(kFarthest).cwiseMax(-kFarthest);
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    if (!held_.allFinite() || !move(in)) return false;
    arguments.value(in.data(), arguments_.data());
    const bool is_settled = (arguments_ - held_).lpNorm<Eigen::Infinity>() <= kSettled;
    exponentials_.move(held_, arguments_);
    // Far down exponentials nothing may be left that determines y.
    if (is_settled) return move(in) && solver_->is_determined();
  }
  return false;
}

}  // namespace courant
