// Which of the known words was meant by an unknown one.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace courant {

// The Damerau–Levenshtein distance (restricted: no part is edited twice): the least number of
// insertions, deletions, replacements and swaps of neighbouring bytes that turn a into b.
std::size_t edit_distance(std::string_view a, std::string_view b);

// ` (did you mean "gravity"?)` with the candidate closest to `word`, upper and lower case being the
// same; nothing if none is close: at most one edit in three letters, and not every letter.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace courant
