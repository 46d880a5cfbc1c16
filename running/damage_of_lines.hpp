// Where a file of lines is no longer what was written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "courant/core/files/content_hash.hpp"

namespace courant {

// "row 7 is not as it was written", or "rows 7 to 9 are …".
std::string damage_of_rows(std::uintmax_t first, std::uintmax_t last);

// What is wrong with a file of a head line, then a row of numbers on each line, that should be as a
// record says: "rows 41 to 118 are not as they were written" where the hashes tell no more, the first
// that is torn where one is. Nothing if all are as they were.
std::optional<std::string> damage_of_lines(const std::filesystem::path& file,
                                           const HashedBytes::Record& record);

}  // namespace courant
