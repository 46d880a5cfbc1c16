// The times of a run.
#pragma once

#include <optional>

#include "courant/integrators/methods/substepping_integrator.hpp"
#include "courant/reading/model.hpp"

namespace courant {

// The times of a run: start + k step for k = 0 … steps. With a transformation of time the step is one in
// τ, dt/dτ = rate, and the run goes on until t = `until`; how many steps that takes is not known before:
// `steps` is then 0, or more than any run makes.
struct TimeSpan {
  double start = 0.0;
  double step = 0.0;
  long steps = 0;
  std::optional<WrittenFormula> rate = {};
  double until = 0.0;
  std::optional<SubsteppingIntegrator::Options> division = {};
  // By which the step is to be chosen, or was.
  std::optional<double> tolerance = {};
  bool is_chosen = true;  // otherwise `step` is the longest that may be chosen

  bool is_transformed() const { return rate.has_value(); }
  // Of t, or of τ.
  double time(long k) const { return (rate ? 0.0 : start) + static_cast<double>(k) * step; }
  double end() const { return rate ? until : time(steps); }
  // The k with time(k) = t up to round-off; nothing in transformed time.
  std::optional<long> step_at(double t) const;
  // Whether the run knows the state at t: at its steps, or at any time between its ends if these are of
  // varying size.
  bool is_known_at(double t) const;
};

}  // namespace courant
