// Small changes of experiments that leave them JSON, so that they come farther than changed letters do.
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

#include "mutation.hpp"

namespace courant::fuzz {

using Json = nlohmann::ordered_json;

// A word that stands in no program, and is planted in texts behind what ends a comment, a text or a line of C.
inline constexpr std::string_view planted_word = "courant_planted";

// One value of the document is left out, doubled, replaced by another one of it, by a number at an edge
// or by something else; a key becomes another key of the format, a word another word of it (a kind, a
// method, a manifold); a formula is put into one that has no derivative, no value or no real one
// somewhere.
void mutate_document(Json& document, Generator& generator);

}  // namespace courant::fuzz
