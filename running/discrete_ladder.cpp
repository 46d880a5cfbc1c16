#include "courant/running/discrete_ladder.hpp"

#include "courant/integrators/certificate/discrete_constraint_algorithm.hpp"

namespace courant {

LadderReport discrete_ladder(const Experiment& experiment, const ConstraintLadder& start) {
  if (!experiment.method || !experiment.time)
    throw ExperimentError("/method",
                          "is missing; the discrete ladder is that of a discretization "
                          "map and a step");
  const auto& system = experiment.model.system;
  const PreparedMethod method = experiment.method->prepare(
      {.system = system, .ladder = start, .initial = start.point, .step = experiment.time->step});
  if (!method.map)
    throw ExperimentError("/method", experiment.method->description +
                                         " has no discretization map; expected a method that has "
                                         "one, such as discretize-first");
  const InitialGuess guess{
      .t = start.point.t, .x = start.point.x, .v = start.point.v, .z = start.point.z};
  return discrete_ladder_report(
      DiscreteConstraintAlgorithm().run(system, method.map, experiment.time->step, guess), *system);
}

}  // namespace courant
