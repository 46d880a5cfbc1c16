// IDA on the stabilised index 2 form: positions and velocities keep to their constraints.
#pragma once

#include <ida/ida.h>

#include <unsupported/Eigen/AutoDiff>

#include "sundials.hpp"

namespace work_precision {

template <class P>
int residual_of(double, N_Vector y, N_Vector dy, N_Vector r, void*) {
  P::residual(N_VGetArrayPointer(y), N_VGetArrayPointer(dy), N_VGetArrayPointer(r));
  return 0;
}

// c ∂r/∂y' + ∂r/∂y by automatic differentiation: with differences IDA gets less far.
template <class P>
int jacobian_of(double, double c, N_Vector y, N_Vector dy, N_Vector, SUNMatrix jacobian, void*,
                N_Vector, N_Vector, N_Vector) {
  constexpr int size = 2 * P::n + 2 * P::m;
  using Scalar = Eigen::AutoDiffScalar<Eigen::Matrix<double, size, 1>>;
  Scalar at[size], rate[size], r[size];
  for (int i = 0; i < size; ++i) {
    at[i] = Scalar(N_VGetArrayPointer(y)[i], size, i);
    rate[i] = Scalar(N_VGetArrayPointer(dy)[i], c * Eigen::Matrix<double, size, 1>::Unit(i));
  }
  P::residual(at, rate, r);
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) SM_ELEMENT_D(jacobian, i, j) = r[i].derivatives()[j];
  return 0;
}

// The multipliers are left out of the error test, as the manual advises for index 2.
template <class P>
Run<P> run_ida(const Context& context, double tolerance) {
  constexpr int size = 2 * P::n + 2 * P::m;
  const Context6 sundials;
  const auto y = vector(size, sundials), dy = vector(size, sundials), id = vector(size, sundials);
  for (const auto& v : {y.get(), dy.get()}) N_VConst(0.0, v);
  const auto start = P::template start<double>();
  double* at = N_VGetArrayPointer(y.get());
  std::copy(start.begin(), start.end(), at);
  P::field(at, N_VGetArrayPointer(dy.get()), at + 2 * P::n + P::m);
  for (int i = 0; i < size; ++i) N_VGetArrayPointer(id.get())[i] = i < 2 * P::n ? 1.0 : 0.0;
  void* memory = IDACreate(sundials);
  const auto owner = owned(memory, [](void* object) { IDAFree(&object); });
  check(IDAInit(memory, residual_of<P>, 0.0, y.get(), dy.get()), "IDAInit");
  // Multipliers have no more digits than round-off divided by the step leaves them: asked for more,
  // they would end the run.
  const auto bounds = vector(size, sundials);
  for (int i = 0; i < size; ++i)
    N_VGetArrayPointer(bounds.get())[i] = i < 2 * P::n ? tolerance : std::max(tolerance, 1e-9);
  IDASVtolerances(memory, tolerance, bounds.get());
  IDASetId(memory, id.get());
  IDASetSuppressAlg(memory, 1);
  // Its own first step is so short that the reactions, which are divided by it, drown in round-off.
  IDASetInitStep(memory, 1e-2 * std::sqrt(tolerance) * P::period());
  IDASetMaxNumSteps(memory, kMostSteps);
  IDASetStopTime(memory, end_of<P>(context));
  const auto matrix = owned(SUNDenseMatrix(size, size, sundials), &SUNMatDestroy);
  const auto linear = owned(SUNLinSol_Dense(y.get(), matrix.get(), sundials), &SUNLinSolFree);
  check(IDASetLinearSolver(memory, linear.get(), matrix.get()), "IDASetLinearSolver");
  check(IDASetJacFn(memory, jacobian_of<P>), "IDASetJacFn");
  double reached = 0.0;
  return run_sundials<P>(context, y.get(), [&](double t) {
    check(IDASolve(memory, t, &reached, y.get(), dy.get(), IDA_NORMAL), "IDASolve");
  });
}

template <class P>
void ida_solver(const Context& context) {
  if constexpr (P::m > 0)
    sweep<P>(context, "IDA, stabilised index 2", kTolerances,
             [&](int k) { return run_ida<P>(context, tolerance(k)); });
}

}  // namespace work_precision
