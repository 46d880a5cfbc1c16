// What the host of this process has: variables of its environment, whole files.
#pragma once

#include <filesystem>
#include <string>

namespace courant {

// The variable of this name; empty if there is none.
std::string environment_variable(const char* name);

// What is in the file; empty if it cannot be read.
std::string content_of(const std::filesystem::path& file);

}  // namespace courant
