// Files that a file of another program includes.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace courant {

// The text of a file that another one includes by this name. Throws std::runtime_error with what is wrong with it.
using IncludedText = std::function<std::string(const std::string& file)>;

// The files of a folder, and of those below, and no others: what a file in it may include.
IncludedText files_below(const std::filesystem::path& folder);

}  // namespace courant
