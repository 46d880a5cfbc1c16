// BoundaryProblem: a motion of a method that is sought by conditions at both ends.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/integrators/step/integrator.hpp"

namespace courant {

// What conditions at one end of a motion may depend on: the point (N), its velocity (Ñ) and unknowns (m) as the system
// determines them, the time, and multipliers of the conditions' own.
struct EndPoint {
  const ExprVector& x;
  const ExprVector& v;
  const ExprVector& z;
  const Expr& t;
  const ExprVector& multipliers;
};

// r(x, v, z, t, ν) = 0 at one end. The multipliers ν are unknowns that stand nowhere else: with conditions g(x) = 0 on
// the states of an optimal control problem, p + Dg(x)ᵀ ν = 0 are its transversality conditions.
struct EndConditions {
  std::function<ExprVector(const EndPoint&)> formula = {};  // empty: no conditions
  std::vector<std::string> names = {};  // of the conditions, for messages; empty: numbered
  Index multipliers = 0;
};

// Find x₀ ∈ M_f, and h > 0 if the time is free, with
//
//   r_0(x_0, t_0) = 0,   r_T(x_n, t_0 + n h) = 0,   x_n = x_0 if periodic,   x_{j+1} = Φ_h(x_j)
//
// for the steps Φ_h of a method: the discrete motion itself meets the conditions, not an approximation of another one.
// With a free time the number of steps n stays and their size changes.
struct BoundaryProblem {
  std::shared_ptr<const Integrator> method;
  ConstraintLadder ladder;  // of the method's system near the guess; regular
  State guess;              // of x_0, with t_0
  // Changes x of a state to what is guessed of the motion at its time; empty: the motion from the guess of x_0.
  std::function<void(State&)> guess_at = {};
  double h = 0.0;  // or a guess of it
  long steps = 0;
  // In how many parts the motion is cut; 0: eight, or one for methods that do not stay on M_f.
  long segments = 0;
  EndConditions initial = {}, final = {};
  bool is_periodic = false;
  bool has_free_time = false;
};

}  // namespace courant
