// Boost.Odeint: methods with step control on the underlying ODE, and a symplectic one.
#pragma once

#include <boost/numeric/odeint/stepper/bulirsch_stoer.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <boost/numeric/odeint/stepper/symplectic_rkn_sb3a_mclachlan.hpp>
#include <stdexcept>

#include "problem.hpp"

namespace work_precision {

namespace odeint = boost::numeric::odeint;

template <class P, class Stepper>
Run<P> run_controlled(const Context& context, Stepper stepper) {
  const auto field = [](const StateOf<P>& y, StateOf<P>& dy, double) {
    double reactions[P::m + 1];
    P::field(y.data(), dy.data(), reactions);
  };
  const double end = end_of<P>(context);
  Run<P> run{.end = P::template start<double>(), .record = Record<P>(end, context.seconds)};
  double t = 0.0, h = 1e-3 * P::period();
  long moment = 1;
  while (t < end) {
    bool last = t + h * (1.0 + 1e-12) >= end;
    if (last) h = end - t;
    const double before = h;
    if (stepper.try_step(field, run.end, t, h) != odeint::success) {
      if (h < 1e-13 * before || h < 1e-14 * end)
        throw std::runtime_error("the step became too small");
      continue;
    }
    if (last) break;
    if (t * kMoments >= static_cast<double>(moment) * end) {
      run.record.add(t, run.end.data());
      moment = static_cast<long>(t / end * kMoments) + 1;
    }
  }
  run.seconds = run.record.seconds();
  return run;
}

// Substitution of q' = v, v' = f(q) in equal steps: order 4 with 6 stages (McLachlan, Atela).
template <class P>
Run<P> run_symplectic(const Context& context, long steps_a_period) {
  using Half = std::array<double, P::n>;
  const auto force = [](const Half& q, Half& f) { P::force(q.data(), f.data()); };
  const long steps = steps_a_period * std::lround(context.periods);
  const double h = P::period() / static_cast<double>(steps_a_period);
  Run<P> run{.end = P::template start<double>(),
             .record = Record<P>(end_of<P>(context), context.seconds)};
  Half q, v;
  std::copy_n(run.end.begin(), P::n, q.begin());
  std::copy_n(run.end.begin() + P::n, P::n, v.begin());
  const auto write = [&] {
    std::copy(q.begin(), q.end(), run.end.begin());
    std::copy(v.begin(), v.end(), run.end.begin() + P::n);
  };
  odeint::symplectic_rkn_sb3a_mclachlan<Half> stepper;
  const long stride = (steps / kMoments) | 1;
  for (long i = 1; i <= steps; ++i) {
    stepper.do_step(force, std::make_pair(std::ref(q), std::ref(v)), 0.0, h);
    if (i % stride == 0) {
      write();
      run.record.add(static_cast<double>(i) * h, run.end.data());
    }
  }
  run.seconds = run.record.seconds();
  write();
  return run;
}

template <class P>
void odeint_solvers(const Context& context) {
  using Y = StateOf<P>;
  sweep<P>(context, "Odeint, dopri5", kTolerances, [&](int k) {
    const double bound = tolerance(k);
    return run_controlled<P>(
        context, odeint::make_controlled(bound, bound, odeint::runge_kutta_dopri5<Y>()));
  });
  sweep<P>(context, "Odeint, fehlberg78", kTolerances, [&](int k) {
    const double bound = tolerance(k);
    return run_controlled<P>(
        context, odeint::make_controlled(bound, bound, odeint::runge_kutta_fehlberg78<Y>()));
  });
  sweep<P>(context, "Odeint, Bulirsch–Stoer", kTolerances, [&](int k) {
    return run_controlled<P>(context, odeint::bulirsch_stoer<Y>(tolerance(k), tolerance(k)));
  });
  if constexpr (P::separable)
    sweep<P>(context, "Odeint, symplectic order 4 (explicit)", 12,
             [&](int k) { return run_symplectic<P>(context, 20L << k); });
}

}  // namespace work_precision
