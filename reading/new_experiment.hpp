// Commented experiments to start from.
#pragma once

#include <string>

#include "courant/reading/findings.hpp"

namespace courant {

// The example of a kind of system as text, with a comment before each key that says what it takes
// and stands for, from the declarations of the kinds; keys that the example does not use are there
// as comments alone. Throws ExperimentError if there is no such kind, or it has no example.
std::string new_experiment(const std::string& type);

// JSON for people: two spaces a level, what fits into 100 columns in one line.
std::string readable_json(const Json& value);

}  // namespace courant
