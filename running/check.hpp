// Checking an experiment: whether its parts keep their laws.
#pragma once

#include "courant/reading/experiment.hpp"

namespace courant {

// The laws of the manifold, the discretization map and the Dirac structure of an experiment, and
// what its method and its invariants measure, as `courant check --json` prints them:
//
//   passed      every law of `checks`
//   checks      {subject, name, law, statement, passed, defect, bound, where}; subjects are
//               "manifold", "discretization map", "structure" and "method"
//   structure   null where the system has none; dimension, rank_of_F, isotropic, coisotropic,
//               dirac, integrable, integrability_defect; where it is integrable or not, the pair
//               (F_D, ω_D), Casimirs, points where ranks jump
//   structures  where there are several (open and closed ports), each with its name
//   method      null without one; claims and what is measured
//   invariants  {name, rate, scale, invariant}: d/dt along S_f
//
// Laws of a method Φ_h, where it claims them:
//   P1  Φ_{-h} ∘ Φ_h = id
//   P2  Φ_h*ω = ω
//
// Points are the consistent initial point and some around it. Symplecticity is that of one step
// from there, its differential by differences of order 4, on T M_f. The order is a slope over
// shorter steps.
//
// Throws ExperimentError as consistent_start does, and where the method does not fit the system.
Json check_experiment(const Experiment& experiment);

}  // namespace courant
