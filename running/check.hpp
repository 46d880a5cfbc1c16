// Checking an experiment: whether its parts keep their laws.
#pragma once

#include "courant/reading/experiment.hpp"

namespace courant {

// The laws of the manifold, the discretization map and the Dirac structure of an experiment, and
// what its method and its invariants measure, as `courant check --json` prints them:
//
//   passed      every law of `checks`
//   checks      {subject, name, law, statement, passed, defect, bound, where}; subjects are
//               "manifold", "discretization map", "structure", "family", "symmetry", "ladder" and
//               "method"
//   structure   null where the system has none; dimension, rank_of_F, isotropic, coisotropic,
//               dirac, integrable, integrability_defect; where it is integrable or not, the pair
//               (F_D, ω_D), Casimirs, points where ranks jump
//   structures  where there are several (open and closed ports), each with its name
//   method      null without one; claims and what is measured
//   symmetries  {name, conserved, remark, kept, drift}: what Noether's theorem says of the momentum,
//               and whether the steps of the method keep it
//   invariants  {name, rate, scale, invariant}: d/dt along S_f
//
// Points are the consistent initial point and some around it. The laws of the method are those of
// check_integrator, at the initial state with the step of the experiment, and
//
//   P12  over eight such steps, and as long in 16, 32 and 64, the method converges to the solution of the equations: its
//        error has a slope of 1/2 or more. That solution is made of the field that a regular ladder leaves, by an
//        explicit method of order 8. By P1 alone a method that converges to something else, as where it does not bear
//        the index of the system, has an order too.
//
// Throws ExperimentError as consistent_start does, and where the method does not fit the system.
Json check_experiment(const Experiment& experiment);

}  // namespace courant
