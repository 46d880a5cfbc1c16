// Coordinates in two classes, each of which moves by the other.
#pragma once

#include <optional>

#include "courant/integrators/step/vector_field.hpp"

namespace courant {

// 0 or 1 for each coordinate, so that the rate of each depends on coordinates of the other class alone, or on time:
// what Staggered takes for θ. The first coordinate of what hangs together has 0. No value where there are no such
// classes, or the rate is no formula.
std::optional<VectorXd> staggering(const VectorFieldFormulas& field);

}  // namespace courant
