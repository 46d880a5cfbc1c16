// An experiment to start from, for each kind of system.
#pragma once

#include <string>

#include "courant/reading/findings.hpp"

namespace courant {

// Small, with parameters, that runs and is as it expects; null for a type that is not of this
// project.
Json system_example(const std::string& type);

}  // namespace courant
