// The tangent map of a run.
#pragma once

#include <optional>

#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/integrators/methods/tangent_map.hpp"
#include "courant/reading/experiment.hpp"

namespace courant {

// Nothing unless the experiment asks for defects. The first step is made here, by a stepper of its own,
// so that what has no tangent map, or no defects, is known before a file is written. Throws
// ExperimentError then: for gauge freedom, for methods that know no differential, for structures that
// the asked defects are not defined for.
std::optional<TangentMap> tangent_of_run(const Experiment& experiment,
                                         const ConstraintLadder& ladder,
                                         const PreparedMethod& method);

}  // namespace courant
