// ARKODE's explicit methods on the underlying ODE. (Its symplectic SPRKStep came with SUNDIALS 6.6.)
#pragma once

#include <arkode/arkode_erkstep.h>

#include "sundials.hpp"

namespace work_precision {

template <class P>
Run<P> run_arkode(const Context& context, ARKODE_ERKTableID table, double tolerance) {
  const Context6 sundials;
  const auto y = vector(2 * P::n, sundials);
  const auto start = P::template start<double>();
  std::copy(start.begin(), start.end(), N_VGetArrayPointer(y.get()));
  void* memory = ERKStepCreate(right_hand_side<P>, 0.0, y.get(), sundials);
  const auto owner = owned(memory, [](void* object) { ERKStepFree(&object); });
  check(ERKStepSetTableNum(memory, table), "ERKStepSetTableNum");
  ERKStepSStolerances(memory, tolerance, tolerance);
  ERKStepSetMaxNumSteps(memory, kMostSteps);
  ERKStepSetStopTime(memory, end_of<P>(context));
  double reached = 0.0;
  return run_sundials<P>(context, y.get(), [&](double t) {
    check(ERKStepEvolve(memory, t, y.get(), &reached, ARK_NORMAL), "ERKStepEvolve");
  });
}

template <class P>
void arkode_solvers(const Context& context) {
  sweep<P>(context, "ARKODE, Dormand–Prince 5", kTolerances, [&](int k) {
    return run_arkode<P>(context, ARKODE_DORMAND_PRINCE_7_4_5, tolerance(k));
  });
  sweep<P>(context, "ARKODE, Fehlberg 8", kTolerances,
           [&](int k) { return run_arkode<P>(context, ARKODE_FEHLBERG_13_7_8, tolerance(k)); });
}

}  // namespace work_precision
