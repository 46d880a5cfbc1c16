// Reading the text of a JSON document.
#pragma once

#include <string_view>

#include "courant/reading/findings.hpp"

namespace courant {

// The document, its keys in the order of the text. Throws ExperimentError with line and column
// (counted from 1, in characters) for what is not JSON, and with the pointers of keys that an
// object has twice.
Json parse_json(std::string_view text);

// The document of a file that the program has written; of keys that an object has twice the first
// counts. As Json::parse, but in linear time: that looks through an object for each of its keys.
// Throws Json::parse_error, and std::invalid_argument for what is nested too deeply and for
// numbers beyond those of double.
Json parse_written_json(std::string_view text);

// Adds a member to an object that has none of this name, without looking through it.
void append_member(Json& object, std::string name, Json value);

}  // namespace courant
