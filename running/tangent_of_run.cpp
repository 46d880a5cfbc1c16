#include "courant/running/tangent_of_run.hpp"

#include <string>

#include "courant/core/words/message.hpp"

namespace courant {
namespace {

const std::string kPlace = "/defects";

// Of the first step; a step that cannot be made is told of by the run.
void try_first_step(TangentMap& map, const PreparedMethod& method, double h) {
  const auto stepper = method.integrator->stepper();
  stepper->tell_parts();
  State state = method.initial;
  try {
    stepper->prepare(state, h);
    map.begin(state.x);
    stepper->step(state, h);
  } catch (const SolveError&) {
    return;
  }
  map.advance(stepper->last());
}

void require_defined(const Experiment& experiment, const TangentMap& map) {
  const auto [symplecticity, volume] = map.defects();
  for (std::size_t i = 0; i < experiment.defects.size(); ++i) {
    const bool is_volume = experiment.defects[i] == Defect::volume;
    if (is_volume ? volume : symplecticity) continue;
    throw ExperimentError(
        kPlace + '/' + std::to_string(i),
        is_volume
            ? "is not defined at the initial point: the set of consistent points has no volume "
              "without a two-form that is regular on it; expected such a structure, or a "
              "system without constraints"
            : "is not defined at the initial point: no structure is known that is the graph "
              "of a two-form, or without constraints of a bivector; expected such a "
              "structure, or \"volume\" alone");
  }
}

}  // namespace

std::optional<TangentMap> tangent_of_run(const Experiment& experiment,
                                         const ConstraintLadder& ladder,
                                         const PreparedMethod& method) {
  if (experiment.defects.empty()) return std::nullopt;
  if (ladder.gauge_dimension > 0)
    throw ExperimentError(kPlace,
                          "are not defined with gauge freedom, where a step is no function of the "
                          "state; expected a regular system");
  try {
    TangentMap map(*method.integrator, ladder.conormals(), experiment.model.structure());
    map.begin(method.initial.x);
    require_defined(experiment, map);
    try_first_step(map, method, experiment.time->step);
    return map;
  } catch (const ExperimentError&) {  // has its own place
    throw;
  } catch (const std::invalid_argument& error) {
    throw ExperimentError(kPlace, without_place(error.what()));
  } catch (const std::domain_error& error) {
    throw ExperimentError(kPlace,
                          "the first step has no tangent map: " + without_place(error.what()));
  }
}

}  // namespace courant
