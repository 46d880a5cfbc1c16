// The search for the start of an experiment.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "courant/core/expressions/linear_map.hpp"
#include "courant/integrators/certificate/nearest_start.hpp"
#include "courant/running/impulsive_start.hpp"
#include "courant/running/ladder_search.hpp"

namespace courant {

// The search for a start that keeps what is given if it can. If velocities or coordinates cannot be kept, it is the
// nearest: positions change least, then velocities and momenta, in the metric of the kinetic energy where there is one,
// then unknowns; what is held does not.
class StartSearch {
 public:
  // Throws ExperimentError where no point of the manifold is near the initial values, or the equations are not finite
  // there.
  StartSearch(const Experiment& experiment, Decider decider);

  ConsistentStart find() const;

  // Nothing is held.
  ConstraintLadder free() const { return ladders_.run(guess_); }
  // From other coordinates, with velocities and unknowns that are held.
  ConstraintLadder free_from(const VectorXd& x) const;

  // What is held, which a point has to round-off.
  void keep_to_the_bit(State& point) const;

 private:
  // A search has units of its own, which may be those of what it met on its way.
  enum class MetTo { all_digits, four_digits };

  // Velocities or unknowns.
  bool more_is_given() const { return initial_.velocity.given.any() || initial_.z.given.any(); }
  InitialGuess holding(InitialGuess guess, const Flags& x, const Flags& velocities,
                       const Flags& unknowns) const;

  // All that is given, of coordinates what x has; with the values that the guess has.
  ConstraintLadder all_kept(const VectorXd& x) const;
  ConstraintLadder all_kept(const InitialGuess& guess, MetTo digits = MetTo::all_digits) const;
  // Whether coordinates moved, and by what is none next to them: zeros alone are measured by 1.
  bool moves_by_round_off(const ConstraintLadder& ladder) const;
  // Whether the equations of a ladder, and what was held, hold at its point.
  bool is_met(const InitialGuess& held, const ConstraintLadder& ladder, MetTo digits) const;
  // The ladder, or that of a search that did not reach a point, where what was held is not met.
  ConstraintLadder met(const InitialGuess& held, ConstraintLadder ladder,
                       MetTo digits = MetTo::all_digits) const;
  // Of what is held alone.
  ConstraintLadder free_ladder() const;

  InitialGuess with_what_follows(double open = 0.0) const;
  template <class Search>
  ConstraintLadder nearest_to_given_unknowns(const Search& search) const;
  ConstraintLadder coordinates_kept() const;
  ConsistentStart coordinates_moved() const;

  // How far what is nearest first of all, the positions, is from what is given.
  double moved_first(const State& point) const;
  // The nearest start of the last level of a ladder, which has one; that of the ladder if it is none.
  ConsistentStart nearest(const ConstraintLadder& ladder) const;
  std::string impasse(const State& point) const;

  const Experiment& experiment_;
  const InitialValues& initial_;
  LinearMap<double> coframe_;
  Flags are_velocities_;  // of the components of v
  InitialGuess guess_;
  VectorXd weight_;  // of the coordinates that are given
  std::vector<NearestStart::Stage> stages_;
  Decider decider_;
  std::shared_ptr<const ChartEquations> equations_;
  std::shared_ptr<const JetEquations> in_digits_;
  LadderSearch ladders_;
};

}  // namespace courant
