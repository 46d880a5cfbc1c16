#include "courant/running/ladder_search.hpp"

#include <utility>

#include "courant/integrators/methods/integrator_in_units.hpp"

namespace courant {
namespace {

ConstraintAlgorithm::Options weighted(const VectorXd& weight) {
  ConstraintAlgorithm::Options options;
  options.metric = SparseMatrixXd(weight.asDiagonal());
  return options;
}

}  // namespace

bool has_no_start(const ConstraintLadder& ladder) {
  return ladder.verdict == Verdict::inconsistent || ladder.verdict == Verdict::not_reached;
}

LadderSearch::LadderSearch(std::shared_ptr<const ChartEquations> equations,
                           std::shared_ptr<const JetEquations> in_digits, const InitialGuess& guess,
                           const VectorXd& weight, Decider decider)
    : equations_(std::move(equations)),
      in_digits_(std::move(in_digits)),
      weight_(weight),
      decider_(decider),
      own_(weighted(weight)) {
  if (is_of_digits_alone(decider)) return;
  const std::shared_ptr<const ImplicitSystem>& system = equations_->system();
  const VectorXd z = guess.z.size() > 0 ? guess.z : system->auxiliary_guess(guess.x, guess.v);
  const auto units = needed_units(equations_, {.t = guess.t, .x = guess.x, .v = guess.v, .z = z});
  if (!units) return;
  measured_ = std::make_shared<SystemInUnits>(system, *units);
  equations_in_units_ = std::make_shared<const ChartEquations>(measured_);
  // The metric of the experiment, up to a factor.
  length_ = units->coordinates.maxCoeff();
  const VectorXd parts = units->coordinates / length_;
  in_units_.emplace(weighted(weight.cwiseProduct(parts.cwiseAbs2())));
}

std::optional<State> LadderSearch::nearly_solved(const InitialGuess& guess) const {
  ConstraintAlgorithm::Options options;
  options.max_level = 0;
  const ConstraintLadder ladder = ConstraintAlgorithm(options).run(equations_, guess);
  if (ladder.levels.empty() || !ladder.point.x.allFinite()) return std::nullopt;
  return ladder.point;
}

ConstraintLadder LadderSearch::run(const InitialGuess& guess) const {
  if (!in_digits_) return by_bounds(guess);
  const ConstraintAlgorithm::Options options = weighted(weight_);
  return is_of_digits_alone(decider_)
             ? certificate_in_digits(*in_digits_, guess, options, decider_)
             : decided_together(by_bounds(guess), *in_digits_, guess, options);
}

ConstraintLadder LadderSearch::by_bounds(const InitialGuess& guess) const {
  ConstraintLadder own = own_.run(equations_, guess);
  if (!measured_) return own;
  const State start =
      measured_->units().measure({.t = guess.t, .x = guess.x, .v = guess.v, .z = guess.z});
  InitialGuess there = guess;
  there.t = start.t;
  there.x = start.x;
  there.v = start.v;
  there.z = start.z;
  ConstraintLadder ladder = restored(in_units_->run(equations_in_units_, there), *measured_);
  // A search that comes to no point in one kind of units says nothing of what was found in the other.
  const bool is_lost = ladder.verdict == Verdict::not_reached && !has_no_start(own);
  if (ladder.levels.empty() || is_lost) return own;
  ladder.moved *= length_;
  // A search that ended without a point where numbers are far apart says nothing of the point that was found here.
  if (!are_alike(ladder, own) && !has_no_start(own))
    ladder.doubts.push_back(
        "In the units of the experiment, in which numbers are far apart, the ladder is another "
        "one, " +
        to_string(own.verdict) + ".");
  return ladder;
}

}  // namespace courant
