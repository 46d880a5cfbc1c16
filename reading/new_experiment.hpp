// Commented experiments to start from.
#pragma once

#include <string>

#include "courant/reading/findings.hpp"

namespace courant {

// The example of a kind of system as text, with a comment before each key that says what it takes
// and stands for, from the declarations of the kinds; keys that the example does not use are there
// as comments alone. With `in_formulas` a system of the catalogue is written as the description by
// formulas that it stands for. Throws ExperimentError if there is no such kind, it has no example,
// or it is none that formulas express.
std::string new_experiment(const std::string& type, bool in_formulas = false);

// JSON for people: two spaces a level, what fits into 100 columns in one line.
std::string readable_json(const Json& value);

}  // namespace courant
