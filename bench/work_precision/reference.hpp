// Motions to more digits than double has: Runge–Kutta–Fehlberg 7(8) with small equal steps.
#pragma once

#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

namespace work_precision {

template <class P>
using LongState = std::array<long double, 2 * P::n>;

template <class P>
void field_of(const LongState<P>& y, LongState<P>& dy, long double) {
  long double reactions[P::m + 1];
  P::field(y.data(), dy.data(), reactions);
}

template <class P>
LongState<P> flow(LongState<P> y, long double time, long steps) {
  boost::numeric::odeint::runge_kutta_fehlberg78<LongState<P>, long double> stepper;
  const long double h = time / static_cast<long double>(steps);
  for (long k = 0; k < steps; ++k) stepper.do_step(field_of<P>, y, 0.0L, h);
  return y;
}

// The period of a motion that starts at rest and has one degree of freedom: it is at rest again
// after half of it. `h` is a small part of it.
template <class P>
long double period_from_rest(long double h) {
  LongState<P> y = flow<P>(P::template start<long double>(), h, 1), next = y;
  long double t = h;
  while ((next = flow<P>(y, h, 1))[P::n] * y[P::n] > 0.0L) {
    y = next;
    t += h;
  }
  // y[n] is the velocity of the first position: Newton's method for its zero.
  for (int iteration = 0; iteration < 6; ++iteration) {
    LongState<P> rate;
    field_of<P>(y, rate, 0.0L);
    const long double step = -y[P::n] / rate[P::n];
    y = flow<P>(y, step, 4);
    t += step;
  }
  return 2.0L * t;
}

}  // namespace work_precision
