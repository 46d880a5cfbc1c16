// What the solvers of SUNDIALS share.
#pragma once

#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <memory>
#include <stdexcept>
#include <string>

#include "problem.hpp"

namespace work_precision {

// Owns what a SUNDIALS function made, which `free` frees.
template <class T, class Free>
std::unique_ptr<std::remove_pointer_t<T>, Free> owned(T object, Free free) {
  if (!object) throw std::runtime_error("SUNDIALS could not make an object");
  return {object, free};
}

class Context6 {
 public:
  Context6() { SUNContext_Create(nullptr, &context_); }
  ~Context6() { SUNContext_Free(&context_); }
  Context6(const Context6&) = delete;
  Context6& operator=(const Context6&) = delete;
  operator SUNContext() const { return context_; }

 private:
  SUNContext context_ = nullptr;
};

inline auto vector(int size, SUNContext context) {
  return owned(N_VNew_Serial(size, context), &N_VDestroy);
}

inline void check(int status, const char* function) {
  if (status < 0)
    throw std::runtime_error(std::string(function) + " returns " + std::to_string(status));
}

// Between two moments: a motion that has left what it approximates may need steps without end.
constexpr long kMostSteps = 200000;

// y' for CVODE and ARKODE.
template <class P>
int right_hand_side(double, N_Vector y, N_Vector dy, void*) {
  double reactions[P::m + 1];
  P::field(N_VGetArrayPointer(y), N_VGetArrayPointer(dy), reactions);
  return 0;
}

// Goes from moment to moment by advance(t), whose results are interpolated, and to the end.
template <class P, class F>
Run<P> run_sundials(const Context& context, N_Vector y, const F& advance) {
  const double end = end_of<P>(context);
  Run<P> run{.record = Record<P>(end, context.seconds)};
  const double* at = N_VGetArrayPointer(y);
  for (long moment = 1; moment <= kMoments; ++moment) {
    const double t = moment == kMoments ? end : end * static_cast<double>(moment) / kMoments;
    advance(t);
    if (moment < kMoments) run.record.add(t, at);
  }
  run.seconds = run.record.seconds();
  std::copy_n(at, 2 * P::n, run.end.begin());
  return run;
}

}  // namespace work_precision
