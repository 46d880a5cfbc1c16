// The start of a curve as a nearest-point problem.
#pragma once

#include <functional>

#include "courant/integrators/certificate/consistent_point.hpp"
#include "courant/integrators/certificate/constraint_ladder.hpp"

namespace courant {

// Of all consistent states the one that is nearest to what is known of it, first things first:
//
//   1. ‖root₁ ((x, v, z)[rows₁] - given₁)‖ is least on S_f,
//   2. ‖root₂ ((x, v, z)[rows₂] - given₂)‖ is least among the states with the rows₁ that were found, …
//
// so that positions and momenta need no common unit. What is held keeps its values throughout. Where positions are
// far from all consistent ones, which may be on several sides, points around the given one are begun from too.
class NearestStart {
 public:
  // The rows of a stage are known beforehand, its metric may depend on the state that the stages before found.
  using Stage = std::function<LeastChange(const State& found)>;
  struct Outcome {
    double distance = 0.0;  // in the metric of the stage
    double slope = 0.0;     // LeastDeviation::slope
    bool is_stationary = true;
  };

  // `from`: the ladder at some consistent point, whose last level says what consistent is. `guess` is what is known,
  // with what is held. Throws std::invalid_argument if the sizes of the guess do not fit the system, or the ladder has
  // no point.
  NearestStart(const std::shared_ptr<const ChartEquations>& equations, const InitialGuess& guess,
               const ConstraintLadder& from, const std::vector<Stage>& stages);

  const State& point() const { return point_; }
  const std::vector<Outcome>& outcomes() const { return outcomes_; }
  // Whether every equation of the last level, and each held value, vanishes next to its terms at the point.
  bool is_consistent() const { return is_consistent_; }
  // Whether each stage ended where its conditions of optimality are met.
  bool is_proven() const { return is_proven_; }

 private:
  State point_;
  std::vector<Outcome> outcomes_;
  bool is_consistent_ = false, is_proven_ = true;
};

}  // namespace courant
