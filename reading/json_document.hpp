// Reading the text of a JSON document.
#pragma once

#include <string_view>

#include "courant/reading/findings.hpp"

namespace courant {

// The document, its keys in the order of the text. Throws ExperimentError with line and column
// (counted from 1, in characters) for what is not JSON, and with the pointers of keys that an
// object has twice.
Json parse_json(std::string_view text);

}  // namespace courant
