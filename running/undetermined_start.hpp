// Starts of which too little is given.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "courant/running/impulsive_start.hpp"

namespace courant {

// Names of coordinates that are not given and that neither M_f nor the given velocities and
// unknowns determine.
std::vector<std::string> undetermined_coordinates(const Experiment& experiment,
                                                  const ConstraintLadder& ladder);

// Whether these coordinates, which nothing determines, are determined where velocities that are not given are 0.
// `start`: how the start of an experiment is found.
bool determined_at_rest(const Experiment& experiment, const std::vector<std::string>& missing,
                        const std::function<ConsistentStart(const Experiment&)>& start);

}  // namespace courant
