// Explicit symplectic methods written by hand for the one problem, composed as Courant composes.
#pragma once

#include "courant/integrators/methods/composition.hpp"
#include "problem.hpp"

namespace work_precision {

// Störmer–Verlet for q'' = f(q).
template <class P>
void verlet(double* y, double h) {
  double f[P::n];
  P::force(y, f);
  for (int i = 0; i < P::n; ++i) y[P::n + i] += 0.5 * h * f[i];
  for (int i = 0; i < P::n; ++i) y[i] += h * y[P::n + i];
  P::force(y, f);
  for (int i = 0; i < P::n; ++i) y[P::n + i] += 0.5 * h * f[i];
}

// step(y, h) makes a step of order 2. Orders 4, 6 and 8 are those of courant::Composition.
template <class P, class F>
Run<P> run_by_hand(const Context& context, int order, long steps_a_period, const F& step) {
  const long steps = steps_a_period * std::lround(context.periods);
  const double h = P::period() / static_cast<double>(steps_a_period);
  std::vector<double> parts = {h};
  if (order > 2) {
    const auto gamma = courant::Composition::coefficients(order);
    parts.assign(gamma.begin(), gamma.end());
    for (double& part : parts) part *= h;
  }
  Run<P> run{.end = P::template start<double>(),
             .record = Record<P>(end_of<P>(context), context.seconds)};
  const long stride = (steps / kMoments) | 1;
  for (long i = 1; i <= steps; ++i) {
    for (const double part : parts) step(run.end.data(), part);
    if (i % stride == 0) run.record.add(static_cast<double>(i) * h, run.end.data());
  }
  run.seconds = run.record.seconds();
  return run;
}

template <class P>
void by_hand_solvers(const Context& context) {
  constexpr bool has_rattle = requires(double* y) { P::rattle(y, 0.0); };
  if constexpr (P::separable || has_rattle) {
    const auto step = [](double* y, double h) {
      if constexpr (has_rattle)
        P::rattle(y, h);
      else
        verlet<P>(y, h);
    };
    const std::string name = has_rattle ? "by hand, RATTLE" : "by hand, Verlet";
    for (const int order : {2, 4, 6, 8}) {
      const long coarsest = order == 2 ? 500 : order == 4 ? 64 : 32;
      sweep<P>(context, order == 2 ? name : name + ", order " + std::to_string(order), 12,
               [&](int k) { return run_by_hand<P>(context, order, coarsest << k, step); });
    }
  }
}

}  // namespace work_precision
