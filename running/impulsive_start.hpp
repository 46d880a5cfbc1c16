// Starts that impulses lead to.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/reading/experiment.hpp"

namespace courant {

// The ladder at a start. `is_impulse`: what moved did so as an impulse moves it, which keeps what the equations
// conserve. `is_nearest`: where given values could not be kept, the conditions of optimality of the nearest start are
// met. `impasse`: empty, or a sentence that says why nothing begins at the given values, only as near to them as one
// likes.
struct ConsistentStart : ConstraintLadder {
  ConsistentStart() = default;
  ConsistentStart(ConstraintLadder ladder, bool impulse = false)
      : ConstraintLadder(std::move(ladder)), is_impulse(impulse) {}
  bool is_impulse = false, is_nearest = true;
  std::string impasse;
};

// Two charged capacitors that are connected keep their charge, two rotors that are joined their momentum: what is
// given of a state and contradicts the constraints jumps to where impulses take it,
//
//   Δx ∈ π_v ker (∂F/∂v, ∂F/∂z)
//
// since in F(x, v, z, t) = 0 velocities and unknowns grow beyond all bounds while x stays finite: charges
// round a loop, momenta along a reaction. Among these directions it is the least Δx.
//
// What is given stays where it can, and only the rest moves. Of a model that starts at 0 of which coordinates alone are
// given the rest begins at 0: a source of current switched on in front of two coils at rest is divided as its impulse
// divides it.
//
// `nearest`: the start that moves least, whatever the directions; it is returned where nothing that was given
// moved, where impulses alone do not lead to a consistent point (as from positions beside a constraint), and where
// the experiment has weights, which choose another metric. `nearest_to`: the same from another x. On Rⁿ only.
ConsistentStart impulsive_start(
    const Experiment& experiment, ConstraintLadder nearest,
    const std::function<ConstraintLadder(const VectorXd& x)>& nearest_to);

}  // namespace courant
