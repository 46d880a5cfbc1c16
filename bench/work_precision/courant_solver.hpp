// Courant: an experiment of the repository, read and prepared as `courant run` does.
#pragma once

#include <fstream>

#include "courant/running/consistent_start.hpp"
#include "problem.hpp"

namespace work_precision {

template <class P>
courant::Experiment experiment(const Context& context, const Choice& choice, double step) {
  std::ifstream file(context.experiments / P::file());
  Json document = Json::parse(file);
  for (const char* key : {"expect", "observe", "symmetries", "events", "output"})
    document.erase(key);
  P::change(document);
  document["method"] = choice.method;
  document["time"] = {{"step", step}, {"end", step}};
  return courant::read_experiment_document(document);
}

// Time is that of the steps: reading, the constraint algorithm and compiling are done before.
template <class P>
Run<P> run_courant(const Context& context, const Choice& choice, int k) {
  const long steps_a_period = choice.steps << k;
  const long steps = steps_a_period * std::lround(context.periods);
  const double h = P::period() * P::time_scale() / static_cast<double>(steps_a_period);
  const courant::Experiment read = experiment<P>(context, choice, h);
  const courant::ConstraintLadder ladder = courant::consistent_start(read);
  const auto method = read.method->prepare({.system = read.model.system,
                                            .ladder = ladder,
                                            .initial = ladder.point,
                                            .step = h,
                                            .backend = courant::Backend::native,
                                            .vocabulary = &read.model.vocabulary});
  const auto stepper = method.integrator->stepper();
  courant::State state = method.initial;
  stepper->prepare(state, h);
  Run<P> run{.record = Record<P>(static_cast<double>(steps) * h, context.seconds)};
  // An odd number, so that the moments come at all phases of a period.
  const long stride = (steps / kMoments) | 1;
  for (long i = 1; i <= steps; ++i) {
    const double t = static_cast<double>(i) * h;
    stepper->step(state, h, t);
    if (i % stride == 0) {
      P::of_state(state.x, run.end.data());
      run.record.add(t, run.end.data());
    }
  }
  run.seconds = run.record.seconds();
  P::of_state(state.x, run.end.data());
  return run;
}

template <class P>
void courant_solvers(const Context& context) {
  for (const Choice& choice : P::choices()) {
    // Order 2 has no digit left over the longest horizons in the time that there is.
    if (context.periods > 1000.0 && !choice.method.contains("order")) continue;
    sweep<P>(context, "Courant, " + choice.label, 10,
             [&](int k) { return run_courant<P>(context, choice, k); });
  }
}

}  // namespace work_precision
