// The ladder at a guess, whatever units its numbers are in.
#pragma once

#include <memory>
#include <optional>

#include "courant/integrators/certificate/certificate_in_digits.hpp"
#include "courant/integrators/certificate/chart_equations.hpp"
#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/integrators/certificate/ladder_in_units.hpp"

namespace courant {

// Whether the search found no point of the last level: what it was to keep may be why.
bool has_no_start(const ConstraintLadder& ladder);

// The ladder of a system whose numbers may be far apart: then that in natural units, and where that in the units of
// the experiment has another verdict about a point, a doubt.
class LadderSearch {
 public:
  // `in_digits`: the equations for a decision by digits; null: ranks are decided by bounds. `guess`: where units are
  // looked for. `weight`: of each coordinate in the metric by which a point is near.
  LadderSearch(std::shared_ptr<const ChartEquations> equations,
               std::shared_ptr<const JetEquations> in_digits, const InitialGuess& guess,
               const VectorXd& weight, Decider decider);

  // What the equations themselves make of the guess, without what they imply; where it contradicts them, what
  // they leave the least residual at. Nothing where they are not defined.
  std::optional<State> nearly_solved(const InitialGuess& guess) const;

  ConstraintLadder run(const InitialGuess& guess) const;

 private:
  ConstraintLadder by_bounds(const InitialGuess& guess) const;

  std::shared_ptr<const ChartEquations> equations_;
  std::shared_ptr<const JetEquations> in_digits_;
  VectorXd weight_;
  Decider decider_;
  ConstraintAlgorithm own_;
  std::shared_ptr<const SystemInUnits> measured_;
  std::shared_ptr<const ChartEquations> equations_in_units_;
  std::optional<ConstraintAlgorithm> in_units_;
  double length_ = 1.0;  // the unit of lengths in the metric of the experiment
};

}  // namespace courant
