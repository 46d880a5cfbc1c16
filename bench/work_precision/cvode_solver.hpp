// CVODE on the underlying ODE: Adams' methods with fixed point iteration, BDF with Newton's method.
#pragma once

#include <cvode/cvode.h>

#include "sundials.hpp"

namespace work_precision {

template <class P>
Run<P> run_cvode(const Context& context, int family, double tolerance) {
  const Context6 sundials;
  const auto y = vector(2 * P::n, sundials);
  const auto start = P::template start<double>();
  std::copy(start.begin(), start.end(), N_VGetArrayPointer(y.get()));
  void* memory = CVodeCreate(family, sundials);
  const auto owner = owned(memory, [](void* object) { CVodeFree(&object); });
  check(CVodeInit(memory, right_hand_side<P>, 0.0, y.get()), "CVodeInit");
  CVodeSStolerances(memory, tolerance, tolerance);
  CVodeSetMaxNumSteps(memory, kMostSteps);
  CVodeSetMaxHnilWarns(memory, -1);
  CVodeSetStopTime(memory, end_of<P>(context));
  const auto matrix = owned(SUNDenseMatrix(2 * P::n, 2 * P::n, sundials), &SUNMatDestroy);
  const auto linear = owned(SUNLinSol_Dense(y.get(), matrix.get(), sundials), &SUNLinSolFree);
  const auto fixed_point = owned(SUNNonlinSol_FixedPoint(y.get(), 0, sundials), &SUNNonlinSolFree);
  check(family == CV_ADAMS ? CVodeSetNonlinearSolver(memory, fixed_point.get())
                           : CVodeSetLinearSolver(memory, linear.get(), matrix.get()),
        "CVODE's solver");
  double reached = 0.0;
  return run_sundials<P>(context, y.get(), [&](double t) {
    check(CVode(memory, t, y.get(), &reached, CV_NORMAL), "CVode");
  });
}

template <class P>
void cvode_solvers(const Context& context) {
  sweep<P>(context, "CVODE, Adams", kTolerances,
           [&](int k) { return run_cvode<P>(context, CV_ADAMS, tolerance(k)); });
  sweep<P>(context, "CVODE, BDF", kTolerances,
           [&](int k) { return run_cvode<P>(context, CV_BDF, tolerance(k)); });
}

}  // namespace work_precision
